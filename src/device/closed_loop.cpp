#include "osteon/device/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "period.h"

namespace osteon {
namespace {

constexpr int kFine = 10;  // steps of the hand in a tick

// Values that come out a number of fine steps after they went in.
class DelayLine {
 public:
  DelayLine(double delay_s, double step_s, const Vec3& initial)
      : values_(static_cast<std::size_t>(std::llround(delay_s / step_s)) + 1, initial) {}
  const Vec3& pass(const Vec3& in) {
    values_[next_] = in;
    next_ = (next_ + 1) % values_.size();
    return values_[next_];
  }

 private:
  std::vector<Vec3> values_;
  std::size_t next_ = 0;
};

// Ends and means over the last two half seconds.
class Ending {
 public:
  void add(double time_s, double end_s, const Vec3& p, const Vec3& force) {
    if (time_s < end_s - 1.0) return;
    const bool last = time_s >= end_s - 0.5;
    double* range = last ? late_ : early_;
    range[0] = std::min(range[0], p.x());
    range[1] = std::max(range[1], p.x());
    if (!last) return;
    ++count_;
    depth_ -= p.x();
    force_ += force.x();
  }
  void fill(WallOutcome& out) const {
    out.swing_m = late_[1] - late_[0];
    out.earlier_swing_m = early_[1] - early_[0];
    out.force_n = force_ / std::max(1, count_);
    out.depth_m = depth_ / std::max(1, count_);
  }

 private:
  double early_[2] = {1e9, -1e9}, late_[2] = {1e9, -1e9};
  double depth_ = 0, force_ = 0;
  int count_ = 0;
};

}  // namespace

WallOutcome press_wall(const WallTrial& trial, const DeviceInfo& info, const SafetyParams& params) {
  SafetyParams used = params;
  used.passivity.on = params.passivity.on && trial.filtered;
  SafetyGate gate(info, used);
  gate.enable();
  const double tick_s = period_s(info), fine_s = tick_s / kFine;
  constexpr double kStart_m = 0.005;
  const double goal_m =
      -trial.press_n / trial.wall_n_per_m - trial.press_n / trial.hand.grip_stiffness_n_per_m;
  // Half a second at rest lets the ramp-in end.
  const double travel_s = (kStart_m - goal_m) / trial.approach_m_per_s;
  const double end_s = 0.5 + travel_s + trial.seconds;

  VirtualHand hand(trial.hand);
  Pose wanted;
  wanted.p.x() = kStart_m;
  hand.reset(wanted);
  DelayLine readings(trial.delay_before ? trial.delay_s : 0, fine_s, wanted.p);
  DelayLine speeds(trial.delay_before ? trial.delay_s : 0, fine_s, Vec3::Zero());
  DelayLine forces(trial.delay_before ? 0 : trial.delay_s, fine_s, Vec3::Zero());
  DeviceSample sample;
  sample.X_VD = wanted;
  Vec3 command = Vec3::Zero();
  Ending ending;
  const auto ticks = static_cast<std::int64_t>(end_s / tick_s);
  for (std::int64_t n = 0; n < ticks; ++n) {
    const double t = static_cast<double>(n) * tick_s;
    sample.time_ns = (n + 1) * to_ns(tick_s);
    const Vec3 wall(std::max(0.0, -sample.X_VD.p.x()) * trial.wall_n_per_m, 0, 0);
    command = gate.filter(wall, sample, 0, tick_s);
    const double way = std::clamp((t - 0.5) * trial.approach_m_per_s, 0.0, kStart_m - goal_m);
    wanted.p.x() = kStart_m - way;
    const bool moving = way > 0 && way < kStart_m - goal_m;
    const Vec3 wanted_v(moving ? -trial.approach_m_per_s : 0, 0, 0);
    for (int i = 0; i < kFine; ++i) {
      const Vec3 felt = forces.pass(command);
      hand.step(fine_s, wanted, wanted_v, felt);
      sample.X_VD.p = readings.pass(hand.pose().p);
      sample.v_V = speeds.pass(hand.velocity());
      ending.add(t, end_s, hand.pose().p, felt);
    }
  }
  WallOutcome out;
  ending.fill(out);
  out.passivity = gate.state().passivity;
  out.cause = gate.cause();
  return out;
}

}  // namespace osteon
