#include "osteon/surgeon/acl_driller.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "osteon/base/random.h"

namespace osteon {
namespace {

// How far the tip stays behind where the hand is wanted, by force: the grip's spring and the
// tool's coupling in a row (HandParams, HapticParams).
constexpr double kGivesWay_m_per_n = 1.0 / 500 + 1.0 / 2000;
constexpr double kAnswer_s = 0.15;    // how fast the force comes to what is wanted
constexpr double kSlowsAt_m = 0.004;  // before the end of a hole the hand presses less
constexpr double kLeastPress_n = 0.35;
constexpr double kThere_m = 0.0001;
// Tissue that has wedged in front of a drill holds more than the hand presses. A running drill that
// is drawn back and comes again takes it along.
constexpr double kGoesOn_m = 0.0001, kStuck_s = 12, kDrawnBack_m = 0.015, kDrawn_m_per_s = 0.02;
constexpr int kMostDrawnBack = 3;
// Before it is given up it is drawn back far out of what has wedged, and has this share of its time
// once more.
constexpr int kLastTries = 2;
constexpr double kDrawnFar_m = 0.06, kOnceMore = 0.5;
constexpr double kOnLine_m = 0.0001, kLeanSettles_s = 0.3;
constexpr double kFastestTurn_rad_per_s = 1.5;
constexpr double kTremble_Hz = 9.1;

}  // namespace

AclDriller::AclDriller(std::vector<AclMove> moves, const Skill& skill)
    : moves_(std::move(moves)), skill_(skill) {
  Random random(skill.seed + 23);
  for (double& phase : phases_) phase = random.uniform(0, 2 * std::numbers::pi);
  const auto first = std::find_if(moves_.begin(), moves_.end(), [](const AclMove& move) {
    return move.kind == AclMove::Kind::kGo;
  });
  if (first == moves_.end()) return;
  p_W_ = first->X_WT.p;
  q_ = first->X_WT.q;
}

void AclDriller::next() {
  ++at_;
  in_move_s_ = 0;
}

void AclDriller::go(const AclMove& move, double dt_s) {
  if (in_move_s_ == 0) {
    q_from_ = q_;
    way_m_ = (move.X_WT.p - p_W_).norm();
    turn_rad_ = q_.angularDistance(move.X_WT.q);
  }
  const double takes_s = std::max(way_m_ / move.m_per_s, turn_rad_ / kFastestTurn_rad_per_s) + dt_s;
  const double left_s = takes_s - in_move_s_;
  if (left_s <= 1.5 * dt_s) {
    p_W_ = move.X_WT.p;
    q_ = move.X_WT.q;
    return next();
  }
  p_W_ += (move.X_WT.p - p_W_) * (dt_s / left_s);
  q_ = q_from_.slerp(std::min(1.0, in_move_s_ / takes_s), move.X_WT.q).normalized();
  in_move_s_ += dt_s;
}

void AclDriller::press(const AclMove& move, double dt_s) {
  const Vec3 back = move.X_WT.rotate(Vec3::UnitZ());
  const double felt_n = force_W_.dot(back);
  const double wanted_m = back.dot(p_W_ - move.X_WT.p);
  const double left_m = wanted_m + kGivesWay_m_per_n * felt_n;
  if (in_move_s_ == 0) {
    least_left_m_ = left_m;
    stuck_s_ = back_m_ = longer_s_ = 0;
    drawn_back_ = last_tries_ = 0;
  }
  const bool late = in_move_s_ > move.value + longer_s_;
  if (back_m_ > 0 || is_stuck(left_m, dt_s) || (late && tries_again(move, left_m))) {
    back_m_ -= kDrawn_m_per_s * dt_s;
    p_W_ = move.X_WT.p + (wanted_m + kDrawn_m_per_s * dt_s) * back;
    q_ = move.X_WT.q;
    in_move_s_ += dt_s;
    return;
  }
  if (left_m < kThere_m || late) {
    if (late) ++given_up_;
    return next();
  }
  const double least_n = std::min(kLeastPress_n, move.force_n);
  const double slow_n = std::clamp(move.force_n * left_m / kSlowsAt_m, least_n, move.force_n);
  const double press_n = move.exact ? slow_n : move.force_n;
  const double m_per_s =
      std::clamp((press_n - felt_n) * kGivesWay_m_per_n / kAnswer_s, -move.m_per_s, move.m_per_s);
  p_W_ = move.X_WT.p + (wanted_m - m_per_s * dt_s) * back;
  q_ = move.X_WT.q;
  in_move_s_ += dt_s;
}

// Once it is, the way back is to be gone.
bool AclDriller::is_stuck(double left_m, double dt_s) {
  if (left_m < least_left_m_ - kGoesOn_m) {
    least_left_m_ = left_m;
    stuck_s_ = 0;
  }
  stuck_s_ += dt_s;
  if (stuck_s_ < kStuck_s || drawn_back_ >= kMostDrawnBack) return false;
  ++drawn_back_;
  stuck_s_ = 0;
  back_m_ = kDrawnBack_m;
  return true;
}

bool AclDriller::tries_again(const AclMove& move, double left_m) {
  if (left_m < kThere_m || last_tries_ >= kLastTries) return false;
  ++last_tries_;
  back_m_ = kDrawnFar_m;
  longer_s_ += kDrawnFar_m / kDrawn_m_per_s + kOnceMore * move.value;
  stuck_s_ = 0;
  return true;
}

// What stands on slanted bone slides down it as it is pressed: the hand goes against that until the
// tip, as it is felt to be, is on the line again. Ends since time does.
void AclDriller::lean(const AclMove& move, double dt_s) {
  const Vec3& back = move.out_W;
  const double felt_n = force_W_.dot(back);
  const Vec3 off = p_W_ + kGivesWay_m_per_n * force_W_ - move.X_WT.p;
  const Vec3 aside = off - off.dot(back) * back;
  const bool stands =
      aside.norm() < kOnLine_m && std::abs(felt_n - move.force_n) < 0.2 * move.force_n;
  settled_s_ = stands ? settled_s_ + dt_s : 0;
  const bool late = in_move_s_ > move.value;
  if (settled_s_ > kLeanSettles_s || late) {
    if (late) ++given_up_;
    settled_s_ = 0;
    return next();
  }
  const double share = dt_s / kAnswer_s;
  const Vec3 wanted = (move.force_n - felt_n) * kGivesWay_m_per_n * -back - aside;
  const double most = move.m_per_s * dt_s;
  Vec3 step = share * wanted;
  if (step.norm() > most) step *= most / step.norm();
  p_W_ += step;
  q_ = move.X_WT.q;
  in_move_s_ += dt_s;
}

void AclDriller::move(double dt_s) {
  const AclMove& now = moves_[at_];
  switch (now.kind) {
    case AclMove::Kind::kGo:
      return go(now, dt_s);
    case AclMove::Kind::kPress:
      return press(now, dt_s);
    case AclMove::Kind::kLean:
      return lean(now, dt_s);
    case AclMove::Kind::kWait:
      if (time_s_ >= now.value) next();
      return;
    case AclMove::Kind::kTake: {
      const auto found = std::find(tray_.begin(), tray_.end(), now.instrument);
      if (found != tray_.end())
        next_ = {CommandKind::kTake, static_cast<double>(found - tray_.begin())};
      return next();
    }
    case AclMove::Kind::kPower:
      next_ = {CommandKind::kPower, now.value};
      return next();
    case AclMove::Kind::kJaw:
      next_ = {CommandKind::kJaw, now.value};
      return next();
  }
}

Pose AclDriller::step(double dt_s) {
  time_s_ += dt_s;
  next_ = {};
  if (!done()) move(dt_s);
  Pose out{p_W_, q_};
  for (std::size_t k = 0; k < 3; ++k)
    out.p[static_cast<Eigen::Index>(k)] +=
        0.5 * skill_.tremor_m * std::sin(2 * std::numbers::pi * kTremble_Hz * time_s_ + phases_[k]);
  return out;
}

Command AclDriller::command() { return next_; }

void AclDriller::feel(const Vec3& force_W) {
  force_W_ = is_finite(force_W) ? force_W : Vec3(Vec3::Zero());
}

}  // namespace osteon
