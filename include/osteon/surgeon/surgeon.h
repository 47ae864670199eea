#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "osteon/base/random.h"
#include "osteon/base/types.h"
#include "osteon/procedure/judge.h"
#include "osteon/surgeon/approach.h"
#include "osteon/surgeon/hand_player.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// Somebody who plays a scenario on any patient: plans from the case's bones, then moves, feels
/// and answers. Says where the hand is wanted; the hand itself (mass, grip) is the caller's. A
/// function of (plan, case, skill, forces).
class Surgeon : public HandPlayer {
 public:
  Surgeon(const ScenarioPlan& plan, const Case& the_case, const Skill& skill, double tip_radius_m);

  Pose step(double dt_s) override;
  void feel(const Vec3& force_W) override;
  bool done() const override { return phase_ == Phase::kDone; }
  const std::vector<std::string>& unreachable() const override { return unreachable_; }
  Pose start() const override;

 private:
  enum class Phase { kThink, kTravel, kApproach, kPress, kSlide, kRetreat, kDone };
  struct Target {
    Approach way;
    double press_n = 1;
    bool faulty = false;
  };

  void choose_targets(const ScenarioPlan& plan, const Case& the_case);
  void add_target(const Case& the_case, std::uint32_t bone);
  void choose_fault();
  void enter(Phase phase);
  void plan_travel();
  void move(double dt_s);
  void approach(double dt_s);
  void press(double dt_s);
  void slide(double dt_s);
  void next_target();
  bool walk(double metres);
  Vec3 outside(const Target& target) const;
  Quat facing(const Target& target) const;
  Vec3 tremor() const;
  const Target& target() const { return targets_[at_]; }

  Skill skill_;
  double tip_radius_m_;
  Surroundings around_;
  Random random_;
  std::vector<Target> targets_;
  std::vector<std::string> unreachable_;
  std::size_t at_ = 0;
  Phase phase_ = Phase::kDone;
  double phase_s_ = 0, time_s_ = 0, pressed_s_ = 0;
  Vec3 aim_W_ = Vec3::Zero();
  Quat q_ = Quat::Identity(), q_from_ = Quat::Identity(), q_to_ = Quat::Identity();
  std::vector<Vec3> way_;
  std::size_t way_at_ = 0;
  double way_m_ = 0, walked_m_ = 0;
  std::deque<double> felt_n_;  // by tick, the oldest first: what is felt after the delay
  double known_n_ = 0;
  double dt_s_ = 0.001;
  std::array<double, 6> phases_{};
};

}  // namespace osteon
