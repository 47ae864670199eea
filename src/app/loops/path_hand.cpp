#include "loops/path_hand.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace osteon {

ProbePath closed_path(ProbePath path, double return_speed_m_per_s) {
  if (path.samples.size() < 2) return path;
  PathSample back = path.samples.front();
  const PathSample last = path.samples.back();
  const double way_m = (back.X_WD.p - last.X_WD.p).norm();
  back.time_s = last.time_s + std::max(1.0, way_m / return_speed_m_per_s);
  path.samples.push_back(back);
  return path;
}

PathHand::PathHand(ProbePath path, const DeviceInfo& info, const HandParams& hand)
    : info_(info), path_(closed_path(std::move(path))), hand_(hand), period_s_(1 / info.rate_hz) {
  assert(!path_.samples.empty());
  hand_.reset(path_.samples.front().X_WD);
}

DeviceSample PathHand::read() {
  const double start_s = path_.samples.front().time_s;
  const double length_s = std::max(period_s_, path_.samples.back().time_s - start_s);
  const double t = start_s + std::fmod(static_cast<double>(ticks_) * period_s_, length_s);
  const PathSample wanted = path_.at(t);
  const Vec3 v_W = (path_.at(t + period_s_).X_WD.p - wanted.X_WD.p) / period_s_;
  hand_.step(period_s_, wanted.X_WD, v_W, force_V_);
  ++ticks_;

  DeviceSample sample;
  sample.time_ns =
      static_cast<std::int64_t>(std::llround(static_cast<double>(ticks_) * period_s_ * 1e9));
  sample.X_VD = hand_.pose();
  sample.v_V = hand_.velocity();
  sample.w_V = hand_.angular_velocity();
  sample.buttons = wanted.button ? 1u : 0u;
  return sample;
}

void PathHand::write_force(const Vec3& force_V) { force_V_ = force_V; }

}  // namespace osteon
