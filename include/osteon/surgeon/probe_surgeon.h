#pragma once

#include <array>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "osteon/base/random.h"
#include "osteon/procedure/judge.h"
#include "osteon/surgeon/hand_player.h"
#include "osteon/surgeon/scope_reach.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// Somebody who touches the tops of bones with a probe that passes a portal, from above, one after
/// the other as a scenario lists them. A function of (plan, case, skill, forces).
class ProbeSurgeon : public HandPlayer {
 public:
  ProbeSurgeon(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
               const Vec3& portal_W, double tip_radius_m);

  Pose start() const override { return pose_; }
  Pose step(double dt_s) override;
  void feel(const Vec3& force_W) override;
  bool done() const override { return phase_ == Phase::kDone; }
  const std::vector<std::string>& unreachable() const override { return unreachable_; }
  /// Where the tip is wanted now.
  Vec3 tip_W() const override { return tip_W_; }
  /// How many bones have been touched.
  std::size_t touched() const override { return at_; }

 private:
  enum class Phase { kThink, kTravel, kLower, kPress, kLift, kFault, kDone };
  struct Target {
    Vec3 top_W;
    double press_n = 1;
  };
  void add_target(const Bone& bone);
  void enter(Phase phase);
  bool go_to(const Vec3& goal_W, double metres);
  void press(double dt_s);
  void lifted();
  Vec3 hover(const Target& target) const { return {target.top_W.x(), target.top_W.y(), over_z_m_}; }
  Pose through_portal(const Vec3& tip_W) const;

  Skill skill_;
  Vec3 portal_W_;
  double tip_radius_m_, over_z_m_ = 0;
  Random random_;
  std::array<double, 9> phases_{};
  std::vector<Target> targets_;
  std::vector<std::string> unreachable_;
  std::map<std::string, double> fault_numbers_;
  std::size_t at_ = 0;
  Phase phase_ = Phase::kDone;
  double phase_s_ = 0, time_s_ = 0, pressed_s_ = 0;
  bool faulted_ = false;
  Vec3 tip_W_ = Vec3::Zero();
  Pose pose_;
  std::deque<double> felt_n_;
  double known_n_ = 0, dt_s_ = 0.001;
};

/// The hand with the scope while the other works: keeps the other's tip in the middle of the
/// picture, a little late.
class FollowingScope : public HandPlayer {
 public:
  /// `probe` must outlive it.
  FollowingScope(const HandPlayer& probe, const ScenarioPlan& plan, const Skill& skill,
                 const ScopeOptics& optics, const Vec3& portal_W);

  Pose start() const override { return pose_; }
  Pose step(double dt_s) override;
  void feel(const Vec3&) override {}
  bool done() const override { return probe_->done(); }
  const std::vector<std::string>& unreachable() const override { return unreachable_; }

 private:
  const HandPlayer* probe_;
  Skill skill_;
  ScopeOptics optics_;
  Vec3 portal_W_, looked_at_W_;
  double away_s_ = 0, fault_s_ = -1, time_s_ = 0;
  std::array<double, 3> phases_{};
  Pose pose_;
  std::vector<std::string> unreachable_;
};

}  // namespace osteon
