#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "osteon/procedure/judge.h"
#include "osteon/surgeon/hand_player.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// A straight piece of a tip's way.
struct WayLeg {
  Vec3 to_W = Vec3::Zero();
  double m_per_s = 0.02;
  double wait_s = 0;                           ///< there
  double press_n = 0;                          ///< above 0: goes no farther once so much is felt
  std::optional<double> power = {}, jaw = {};  ///< set as the leg begins
  bool place = false;                          ///< a place of the exercise has been done with it
  bool level = false;  ///< the hinge of the jaws; of the first leg, for the whole way
  bool leans = false;  ///< against what is there: who looks after the tip stays where it began
};

/// What works through a portal.
struct WayTool {
  Vec3 portal_W = Vec3::Zero();
  double tip_radius_m = 0.00075;
};

/// How an instrument whose shaft points to `back_W`, a unit vector, is turned about it so that the
/// hinge of its jaws, x of Tool, is level.
Quat level_jaws(const Vec3& back_W);

/// The way of a tip that does what the scenario's goals ask of a tip: from mark to mark of a
/// groove, through pairs of marks, with rings to pegs, or along the edge of a part that shall go.
/// With the skill's fault in it, where the fault is the tip's. Empty: no goal asks for a way.
std::vector<WayLeg> plan_way(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
                             const WayTool& tool);

/// Somebody who leads the tip of an instrument along a way, through a portal. A function of (way,
/// skill, forces).
class WaySurgeon : public HandPlayer {
 public:
  /// The hand begins where the first leg ends.
  WaySurgeon(std::vector<WayLeg> way, const Skill& skill, const Vec3& portal_W);

  Pose start() const override { return pose_; }
  Pose step(double dt_s) override;
  void feel(const Vec3& force_W) override;
  bool done() const override { return at_ >= way_.size(); }
  Command command() override;
  const std::vector<std::string>& unreachable() const override { return unreachable_; }
  Vec3 tip_W() const override { return seen_tip_W_; }
  std::size_t touched() const override { return places_; }

 private:
  void begin_leg();
  void move(double dt_s);
  Pose through_portal(const Vec3& tip_W) const;
  Vec3 strayed_W() const;

  std::vector<WayLeg> way_;
  Skill skill_;
  Vec3 portal_W_;
  std::array<double, 9> phases_{};
  std::vector<std::string> unreachable_;
  std::deque<Command> commands_;
  std::size_t at_ = 0, places_ = 0;
  bool there_ = false;
  double waited_s_ = 0, time_s_ = 0;
  Vec3 tip_W_ = Vec3::Zero(), seen_tip_W_ = Vec3::Zero(), lead_W_ = Vec3::Zero();
  Pose pose_;
  std::deque<Vec3> felt_W_;
  Vec3 known_W_ = Vec3::Zero();
  double dt_s_ = 0.001;
};

}  // namespace osteon
