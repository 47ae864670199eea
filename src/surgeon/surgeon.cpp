#include "osteon/surgeon/surgeon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/base/turn.h"

namespace osteon {
namespace {

constexpr double kSlowZone_m = 0.006;        // above a bone: from here at the speed of approach
constexpr double kFelt_n = 0.15;             // a contact that a hand notices
constexpr double kFarthestPress_m = 0.02;    // past where the bone should be
constexpr double kAnswer_m_per_n_s = 0.004;  // how fast the hand corrects a wrong force
constexpr double kLongestPress_s = 6;
constexpr double kSlideSpeed_m_per_s = 0.02;
constexpr double kStrike_m_per_s = 0.16;
constexpr double kFaultPress_n = 6.5;
constexpr double kSlidePress_n = 3.0;

Vec3 on_arc(const Surroundings& around, const Vec3& from, const Vec3& to, double f) {
  const Vec3 a = (from - around.center_W).normalized();
  const Vec3 b = (to - around.center_W).normalized();
  Vec3 d = (1 - f) * a + f * b;
  if (d.norm() < 0.3) {  // nearly opposite: over the side
    const Vec3 any = std::abs(a.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
    d += a.cross(any).normalized();
  }
  return around.center_W + d.normalized() * around.radius_m;
}

}  // namespace

Surgeon::Surgeon(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
                 double tip_radius_m)
    : skill_(skill),
      tip_radius_m_(tip_radius_m),
      around_(surroundings_of(the_case)),
      random_(skill.seed) {
  for (double& phase : phases_) phase = random_.uniform(0, 2 * std::numbers::pi);
  choose_targets(plan, the_case);
  choose_fault();
  if (targets_.empty()) return;
  aim_W_ = outside(targets_[0]);
  q_ = facing(targets_[0]);
  enter(Phase::kThink);
}

void Surgeon::choose_targets(const ScenarioPlan& plan, const Case& the_case) {
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      for (const std::uint32_t bone : goal.bones) add_target(the_case, bone);
}

void Surgeon::add_target(const Case& the_case, std::uint32_t bone) {
  const double skips = random_.uniform();
  const double off_n = random_.normal(0, skill_.press_spread_n);
  if (skips < skill_.skip_share) return;
  const auto way = find_approach(the_case, bone, tip_radius_m_, skill_.seed);
  if (!way) {
    unreachable_.push_back(the_case.bones[bone].name);
    return;
  }
  targets_.push_back({*way, std::max(0.6, skill_.press_n + off_n), false});
}

// The fault is made where it is made best: the slide on the longest line, the others on the bone
// that stands freest; what is left out is the last.
void Surgeon::choose_fault() {
  if (skill_.fault.empty() || targets_.empty()) return;
  if (skill_.fault == "left_out") {
    targets_.pop_back();
    return;
  }
  const auto better = [&](const Target& a, const Target& b) {
    if (skill_.fault == "slid_over") return a.way.free_m < b.way.free_m;
    return a.way.clearance_m < b.way.clearance_m;
  };
  Target& chosen = *std::max_element(targets_.begin(), targets_.end(), better);
  chosen.faulty = true;
  if (skill_.fault == "pressed_over") chosen.press_n = kFaultPress_n;
  if (skill_.fault == "slid_over") chosen.press_n = kSlidePress_n;
}

// Where the line from the bone along its normal leaves the ball around the case.
Vec3 Surgeon::outside(const Target& t) const {
  const Vec3 r = t.way.p_W - around_.center_W;
  const double b = r.dot(t.way.n_W);
  const double c = r.squaredNorm() - around_.radius_m * around_.radius_m;
  return t.way.p_W + t.way.n_W * (-b + std::sqrt(std::max(0.0, b * b - c)));
}

Quat Surgeon::facing(const Target& t) const { return turn_between(Vec3::UnitZ(), t.way.n_W); }

Pose Surgeon::start() const { return {aim_W_, q_}; }

void Surgeon::enter(Phase phase) {
  phase_ = phase;
  phase_s_ = 0;
  if (phase == Phase::kTravel) plan_travel();
  if (phase == Phase::kPress) pressed_s_ = 0;
}

void Surgeon::plan_travel() {
  constexpr int kSteps = 24;
  const Vec3 from = aim_W_;
  const Vec3 to = outside(target());
  const Vec3 astray = random_.direction() * skill_.detour_m;
  way_.assign(1, from);
  for (int i = 1; i < kSteps; ++i) {
    const double f = static_cast<double>(i) / kSteps;
    const Vec3 out = astray.dot(from - around_.center_W) < 0 ? Vec3(-astray) : astray;
    way_.push_back(on_arc(around_, from, to, f) + 4 * f * (1 - f) * out);
  }
  way_.push_back(to);
  way_at_ = 0;
  way_m_ = walked_m_ = 0;
  for (std::size_t i = 1; i < way_.size(); ++i) way_m_ += (way_[i] - way_[i - 1]).norm();
  q_from_ = q_;
  q_to_ = facing(target());
}

// Moves the aim along the way; true at its end.
bool Surgeon::walk(double metres) {
  walked_m_ += metres;
  while (way_at_ + 1 < way_.size() && metres > 0) {
    const Vec3 rest = way_[way_at_ + 1] - aim_W_;
    const double left = rest.norm();
    if (left > metres) {
      aim_W_ += rest * (metres / left);
      break;
    }
    aim_W_ = way_[++way_at_];
    metres -= left;
  }
  q_ = q_from_.slerp(std::min(1.0, walked_m_ / std::max(way_m_, 1e-9)), q_to_);
  return way_at_ + 1 >= way_.size();
}

void Surgeon::approach(double dt_s) {
  const Target& t = target();
  const double above = (aim_W_ - t.way.p_W).dot(t.way.n_W) - tip_radius_m_;
  const bool strikes = t.faulty && skill_.fault == "struck";
  const bool slow = above < kSlowZone_m && !strikes;
  const double speed = strikes ? kStrike_m_per_s
                       : slow  ? skill_.approach_m_per_s
                               : skill_.travel_m_per_s;
  aim_W_ -= t.way.n_W * (speed * dt_s);
  // Who strikes stops by sight, a little late.
  if (known_n_ > kFelt_n || (strikes && above < -0.0015)) return enter(Phase::kPress);
  if (above < -kFarthestPress_m) enter(Phase::kRetreat);
}

void Surgeon::press(double dt_s) {
  const Target& t = target();
  const double step = std::clamp((t.press_n - known_n_) * kAnswer_m_per_n_s, -0.02, 0.02) * dt_s;
  aim_W_ -= t.way.n_W * step;
  aim_W_ += t.way.along_W * (skill_.drift_m_per_s * dt_s);
  if (known_n_ > 0.7 * t.press_n) pressed_s_ += dt_s;
  if (pressed_s_ < skill_.dwell_s && phase_s_ < kLongestPress_s) return;
  enter(t.faulty && skill_.fault == "slid_over" ? Phase::kSlide : Phase::kRetreat);
}

void Surgeon::slide(double dt_s) {
  const Target& t = target();
  const double step = std::clamp((t.press_n - known_n_) * kAnswer_m_per_n_s, -0.02, 0.02) * dt_s;
  aim_W_ -= t.way.n_W * step;
  aim_W_ += t.way.along_W * (kSlideSpeed_m_per_s * dt_s);
  if (phase_s_ * kSlideSpeed_m_per_s > std::min(t.way.free_m, 0.014)) enter(Phase::kRetreat);
}

void Surgeon::next_target() {
  if (++at_ < targets_.size()) return enter(Phase::kThink);
  --at_;
  phase_ = Phase::kDone;
}

void Surgeon::move(double dt_s) {
  switch (phase_) {
    case Phase::kThink:
      if (phase_s_ >= skill_.think_s) enter(Phase::kTravel);
      return;
    case Phase::kTravel:
      if (walk(skill_.travel_m_per_s * dt_s)) enter(Phase::kApproach);
      return;
    case Phase::kApproach:
      return approach(dt_s);
    case Phase::kPress:
      return press(dt_s);
    case Phase::kSlide:
      return slide(dt_s);
    case Phase::kRetreat: {
      const Vec3 goal = outside(target());
      aim_W_ += target().way.n_W * (0.5 * skill_.travel_m_per_s * dt_s);
      if ((goal - aim_W_).dot(target().way.n_W) <= 0) next_target();
      return;
    }
    case Phase::kDone:
      return;
  }
}

// Two waves of physiological tremor an axis.
Vec3 Surgeon::tremor() const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 6; ++k) {
    const double hz = k < 3 ? 8.3 : 10.7;
    sum[static_cast<Eigen::Index>(k % 3)] +=
        0.5 * skill_.tremor_m * std::sin(2 * std::numbers::pi * hz * time_s_ + phases_[k]);
  }
  return sum;
}

Pose Surgeon::step(double dt_s) {
  dt_s_ = dt_s;
  time_s_ += dt_s;
  phase_s_ += dt_s;
  move(dt_s);
  return {aim_W_ + tremor(), q_};
}

void Surgeon::feel(const Vec3& force_W) {
  felt_n_.push_back(is_finite(force_W) ? force_W.norm() : 0);
  const auto late = static_cast<std::size_t>(skill_.delay_s / dt_s_);
  if (felt_n_.size() <= late) return;
  known_n_ = felt_n_.front();
  felt_n_.pop_front();
}

}  // namespace osteon
