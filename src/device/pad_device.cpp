#include "osteon/device/pad_device.h"

#include <algorithm>
#include <cmath>

#include "period.h"

namespace osteon {
namespace {

// Stick value with the dead zone cut out and the rest stretched back to [-1, 1].
double shaped(double stick, double dead_zone) {
  if (!std::isfinite(stick)) return 0;
  const double s = std::clamp(stick, -1.0, 1.0);
  const double past = std::abs(s) - dead_zone;
  return past > 0 ? std::copysign(past / (1 - dead_zone), s) : 0;
}

}  // namespace

Vec3 past_dead_zone(const Vec3& sticks, double dead_zone) {
  return {shaped(sticks.x(), dead_zone), shaped(sticks.y(), dead_zone),
          shaped(sticks.z(), dead_zone)};
}

PadDevice::PadDevice(const DeviceInfo& info, const PadParams& params)
    : info_(info), params_(params) {
  params_.dead_zone = std::clamp(params_.dead_zone, 0.0, 0.9);
}

void PadDevice::set_axes(const PadAxes& axes) { axes_.publish(axes); }

DeviceSample PadDevice::read() {
  const PadAxes& axes = axes_.read();
  const bool live = open_ && axes.connected;
  const double dt_s = period_s(info_);
  DeviceSample sample;
  if (live) {
    sample.w_V = params_.turn_rate_rad_per_s * past_dead_zone(axes.turn_V, params_.dead_zone);
    const Vec3 v_V = params_.speed_m_per_s * past_dead_zone(axes.move_V, params_.dead_zone);
    const Vec3 half_extent = 0.5 * info_.workspace_m;
    const Vec3 moved = (X_VD_.p + dt_s * v_V).cwiseMax(-half_extent).cwiseMin(half_extent);
    sample.v_V = (moved - X_VD_.p) / dt_s;
    X_VD_.p = moved;
    const Vec3 half = 0.5 * dt_s * sample.w_V;
    X_VD_.q = (Quat(1, half.x(), half.y(), half.z()) * X_VD_.q).normalized();
    time_ns_ += to_ns(dt_s);
  }
  sample.time_ns = time_ns_;
  sample.X_VD = X_VD_;
  sample.buttons = axes.buttons;
  sample.connected = live;
  return sample;
}

// A gamepad has no motors that push in a direction.
void PadDevice::write_force(const Vec3&) {}

}  // namespace osteon
