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

// A swing that stays so small for a second only dies: a hundredth of what counts as a swing at all.
constexpr double kRest_m = 1e-7;

// Ends and means of half seconds, one after the other.
class HalfSeconds {
 public:
  void add(double p_m, double force_n) {
    now_.low_m = std::min(now_.low_m, p_m);
    now_.high_m = std::max(now_.high_m, p_m);
    now_.depth_m -= p_m;
    now_.force_n += force_n;
    ++now_.count;
  }
  void next() {
    early_ = late_;
    late_ = now_;
    now_ = {};
  }
  bool at_rest() const { return early_.swing_m() < kRest_m && late_.swing_m() < kRest_m; }
  // Of the last two whole ones.
  void fill(WallOutcome& out) const {
    out.swing_m = late_.swing_m();
    out.earlier_swing_m = early_.swing_m();
    out.force_n = late_.force_n / std::max(1, late_.count);
    out.depth_m = late_.depth_m / std::max(1, late_.count);
  }

 private:
  struct Half {
    double low_m = HUGE_VAL, high_m = -HUGE_VAL;
    double depth_m = 0, force_n = 0;
    int count = 0;
    double swing_m() const { return count > 0 ? high_m - low_m : HUGE_VAL; }
  };
  Half early_, late_, now_;
};

// The hand, its way onto the wall, and the loop around it.
class WallLoopRun {
 public:
  WallLoopRun(const WallTrial& trial, const DeviceInfo& info, const SafetyParams& params)
      : trial_(trial),
        tick_s_(period_s(info)),
        fine_s_(tick_s_ / kFine),
        goal_m_(-trial.press_n / trial.wall_n_per_m -
                trial.press_n / trial.hand.grip_stiffness_n_per_m),
        gate_(info, params),
        hand_(trial.hand),
        wanted_(at(kStart_m)),
        readings_(trial.delay_before ? trial.delay_s : 0, fine_s_, wanted_.p),
        speeds_(trial.delay_before ? trial.delay_s : 0, fine_s_, Vec3::Zero()),
        forces_(trial.delay_before ? 0 : trial.delay_s, fine_s_, Vec3::Zero()) {
    gate_.enable();
    hand_.reset(wanted_);
    sample_.X_VD = wanted_;
  }

  WallOutcome run() {
    // Half a second at rest lets the ramp-in end.
    const std::int64_t start = ticks_in(0.5 + (kStart_m - goal_m_) / trial_.approach_m_per_s);
    for (std::int64_t n = 0; n < start; ++n) tick(nullptr);
    HalfSeconds halves;
    const auto count = static_cast<int>(std::lround(trial_.seconds / 0.5));
    for (int half = 0; half < count && !halves.at_rest(); ++half) {
      const std::int64_t end = start + ticks_in(0.5 * (half + 1));
      while (tick_ < end) tick(&halves);
      halves.next();
    }
    WallOutcome out;
    halves.fill(out);
    out.passivity = gate_.state().passivity;
    out.cause = gate_.cause();
    return out;
  }

 private:
  static constexpr double kStart_m = 0.005;
  static Pose at(double x_m) { return {Vec3(x_m, 0, 0), Quat::Identity()}; }
  std::int64_t ticks_in(double time_s) const { return std::llround(time_s / tick_s_); }

  void tick(HalfSeconds* halves) {
    const double t = static_cast<double>(tick_++) * tick_s_;
    sample_.time_ns = tick_ * to_ns(tick_s_);
    const Vec3 wall(std::max(0.0, -sample_.X_VD.p.x()) * trial_.wall_n_per_m, 0, 0);
    const Vec3 command = gate_.filter(wall, sample_, 0, tick_s_);
    const double way = std::clamp((t - 0.5) * trial_.approach_m_per_s, 0.0, kStart_m - goal_m_);
    wanted_.p.x() = kStart_m - way;
    const bool moving = way > 0 && way < kStart_m - goal_m_;
    const Vec3 wanted_v(moving ? -trial_.approach_m_per_s : 0, 0, 0);
    for (int i = 0; i < kFine; ++i) {
      const Vec3 felt = forces_.pass(command);
      hand_.step(fine_s_, wanted_, wanted_v, felt);
      sample_.X_VD.p = readings_.pass(hand_.pose().p);
      sample_.v_V = speeds_.pass(hand_.velocity());
      if (halves) halves->add(hand_.pose().p.x(), felt.x());
    }
  }

  const WallTrial& trial_;
  double tick_s_, fine_s_, goal_m_;
  SafetyGate gate_;
  VirtualHand hand_;
  Pose wanted_;
  DelayLine readings_, speeds_, forces_;
  DeviceSample sample_;
  std::int64_t tick_ = 0;
};

}  // namespace

WallOutcome press_wall(const WallTrial& trial, const DeviceInfo& info, const SafetyParams& params) {
  SafetyParams used = params;
  used.passivity.on = params.passivity.on && trial.filtered;
  return WallLoopRun(trial, info, used).run();
}

}  // namespace osteon
