#pragma once

#include <array>
#include <cstdint>
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

/// Somebody who looks at every mark of a scenario through an arthroscope: finds for each a
/// distance and a turn of the scope from which nothing hides it, goes from one to the next over the
/// portal, and holds each until the picture has been right for long enough. A function of
/// (plan, case, skill, forces).
class ScopeSurgeon : public HandPlayer {
 public:
  struct Scope {
    ScopeOptics optics;
    Vec3 portal_W = Vec3::Zero();
    double radius_m = 0.002;
  };
  ScopeSurgeon(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
               const Scope& scope);

  Pose start() const override;
  Pose step(double dt_s) override;
  void feel(const Vec3& force_W) override;
  bool done() const override { return phase_ == Phase::kDone; }
  const std::vector<std::string>& unreachable() const override { return unreachable_; }

 private:
  enum class Phase { kThink, kTravel, kHold, kFault, kDone };
  struct Target {
    Gaze gaze;
    double near_m = 0, far_m = 0, central = 0.5, for_s = 1.5, span_m = 0, level_rad = 3.2;
  };
  void add_target(const Case& the_case, const PlannedRule& goal, std::uint32_t mark);
  bool find_gaze(const Case& the_case, Target& target) const;
  bool is_clear(const Case& the_case, const Gaze& gaze) const;
  bool is_in_sight(const Case& the_case, const Vec3& eye_W, const Vec3& at_W) const;
  void enter(Phase phase);
  void begin_travel();
  void travel();
  void hold(double dt_s);
  void next_target();
  Gaze wandered(Gaze gaze) const;
  bool looks_right(const Gaze& meant) const;
  Pose posed(const Gaze& gaze) const;
  Pose faulty(Pose pose, double dt_s);
  double fault_share(double ramp_s, double stay_s) const;
  Vec3 tremor() const;
  const Target& target() const { return targets_[at_]; }

  Skill skill_;
  Scope scope_;
  Random random_;
  std::array<double, 10> phases_{};
  std::vector<Target> targets_;
  std::vector<std::string> unreachable_;
  std::map<std::string, double> fault_numbers_;
  std::size_t at_ = 0;
  Phase phase_ = Phase::kDone;
  double phase_s_ = 0, time_s_ = 0, right_s_ = 0, travel_s_ = 1, pushed_m_ = 0, yielded_s_ = -1;
  bool faulted_ = false;
  Gaze gaze_, from_;
  Pose pose_;
  std::deque<double> felt_n_;
  double known_n_ = 0, dt_s_ = 0.001;
};

}  // namespace osteon
