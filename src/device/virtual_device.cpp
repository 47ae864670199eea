#include "osteon/device/virtual_device.h"

#include "period.h"

namespace osteon {

VirtualDevice::VirtualDevice(const DeviceInfo& info, const HandParams& hand)
    : info_(info), hand_(hand) {}

void VirtualDevice::set_target(const Pose& wanted_VD, const Vec3& wanted_v_V,
                               std::uint32_t buttons) {
  if (is_finite(wanted_VD) && is_finite(wanted_v_V))
    target_.publish({wanted_VD, wanted_v_V, buttons});
}

DeviceSample VirtualDevice::read() {
  const Target& target = target_.read();
  const double dt_s = period_s(info_);
  if (open_) {
    hand_.step(dt_s, target.X_VD, target.v_V, force_V_);
    time_ns_ += to_ns(dt_s);
  }
  return {time_ns_,       hand_.pose(), hand_.velocity(), hand_.angular_velocity(),
          target.buttons, open_};
}

void VirtualDevice::write_force(const Vec3& force_V) {
  force_V_ = is_finite(force_V) && open_ ? force_V : Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (!info_.force_axes[static_cast<std::size_t>(i)]) force_V_[i] = 0;
  torque_V_ = is_finite(wanted_torque_V_) && open_ ? wanted_torque_V_ : Vec3::Zero();
  for (int i = 0; i < 3; ++i)
    if (!info_.torque_axes[static_cast<std::size_t>(i)]) torque_V_[i] = 0;
  wanted_torque_V_.setZero();
}

void VirtualDevice::close() {
  force_V_.setZero();
  torque_V_.setZero();
  open_ = false;
}

}  // namespace osteon
