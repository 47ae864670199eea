#include "osteon/device/mouse_device.h"

#include "period.h"

namespace osteon {

MouseDevice::MouseDevice(const DeviceInfo& info, double smoothing_s)
    : info_(info), smoothing_s_(smoothing_s > 0 ? smoothing_s : period_s(info)) {}

void MouseDevice::set_target(const Pose& wanted_VD, std::uint32_t buttons) {
  if (is_finite(wanted_VD)) target_.publish({wanted_VD, buttons});
}

// x'' = (x_wanted - x) / T^2 - 2 x' / T, both terms taken implicitly: no overshoot at any step.
void MouseDevice::move_towards(const Pose& wanted_VD, double dt_s) {
  const double a = dt_s / smoothing_s_;
  const double damp = 1 / (1 + 2 * a + a * a);
  v_V_ = damp * (v_V_ + (a / smoothing_s_) * (wanted_VD.p - X_VD_.p));
  X_VD_.p += dt_s * v_V_;

  // The rotation error as a vector (2 x the quaternion's vector part) through the same filter.
  const Quat d = wanted_VD.q * X_VD_.q.conjugate();
  const Vec3 error = 2 * (d.w() < 0 ? Vec3(-d.vec()) : Vec3(d.vec()));
  w_V_ = damp * (w_V_ + (a / smoothing_s_) * error);
  const Vec3 half = 0.5 * dt_s * w_V_;
  X_VD_.q = (Quat(1, half.x(), half.y(), half.z()) * X_VD_.q).normalized();
}

DeviceSample MouseDevice::read() {
  const Target& target = target_.read();
  const double dt_s = period_s(info_);
  if (open_) {
    move_towards(target.X_VD, dt_s);
    time_ns_ += to_ns(dt_s);
  }
  return {time_ns_, X_VD_, v_V_, w_V_, target.buttons, open_};
}

// A mouse has no motors.
void MouseDevice::write_force(const Vec3&) {}

}  // namespace osteon
