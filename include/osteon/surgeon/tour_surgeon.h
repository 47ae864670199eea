#pragma once

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osteon/procedure/judge.h"
#include "osteon/scene/case.h"
#include "osteon/surgeon/hand_player.h"
#include "osteon/surgeon/scope_reach.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// How deep a shaft is drawn back between two places.
inline constexpr double kTourRest_m = 0.005;

/// What one hand of a tour holds.
struct TourTool {
  std::string hand;                   ///< its name in the scenario
  std::optional<ScopeOptics> optics;  ///< none: it touches
  Vec3 offset_T = Vec3::Zero();       ///< the shaft's axis runs along z of Tool through this point
  double shaft_radius_m = 0.00075;
  double tip_radius_m = 0.0005;
  Vec3 portal_W = Vec3::Zero();  ///< through which it goes until a goal names another
};

/// A shaft that passes through a portal: the point of its axis beside the tip lies `depth_m` below.
struct TourPlace {
  Vec3 portal_W = Vec3::Zero();
  Quat q = Quat::Identity();
  double depth_m = 0;
};
/// The pose of Tool.
Pose pose_at(const TourPlace& place, const TourTool& tool);

/// A place from which the mark is near the middle of the picture and from no place about it hidden,
/// from `near_m` to `far_m`, with room about the shaft; the roomiest of a fixed set. None: there is
/// none.
struct TourGaze {
  Vec3 at_W = Vec3::Zero();
  double near_m = 0.003, far_m = 0.015;
};
std::optional<TourPlace> find_look(const Case& the_case, const TourTool& tool, const Vec3& portal_W,
                                   const TourGaze& gaze);

/// A place from which the tip, pushed along the shaft, meets the bone squarely, with room on its
/// way in and about the shaft, clear of another hand's shaft where one is given. None: there is
/// none.
std::optional<TourPlace> find_touch(const Case& the_case, const TourTool& tool,
                                    const Vec3& portal_W, std::uint32_t bone,
                                    const TourPlace* other, std::uint64_t seed);

/// Whether two shafts in their places leave each other room, with what is above the skin of both.
bool clear_of(const TourPlace& a, const TourPlace& b);
/// How much farther out along its shaft a tool has to be drawn on its way from one place to another
/// so that it passes other hands' shafts: the least of a few lengths, 0 where the plain way passes
/// them. None: no length is enough.
std::optional<double> lift_over(const TourPlace& from, const TourPlace& to,
                                const std::vector<TourPlace>& others);
/// The place, turned about the way into its portal by as little as leaves it clear of the others,
/// with room about the shaft. Where no turn does, as it is.
TourPlace turned_clear(const Case& the_case, const TourTool& tool, const TourPlace& place,
                       const std::vector<TourPlace>& others);
/// Outside the skin between two places, from 0 to 1: by the plain way (no lift), or out along the
/// one's shaft, across, and in along the other's.
TourPlace place_between(const TourPlace& from, const TourPlace& to, double lift_m, double share);

/// How far out of the portal a tool is drawn that goes to another place.
inline constexpr double kTourOut_m = 0.012;

/// One thing that one hand does.
struct TourVisit {
  enum class Kind {
    kEnter,
    kLook,
    kTouch,
    kWaitOver  ///< over its portal, until another hand has passed
  };
  std::size_t hand = 0;
  Kind kind = Kind::kLook;
  bool faulty = false;  ///< the one thing that is done wrong is done here
  TourPlace place;
  double for_s = 1.5;
  double lift_m = 0;  ///< on the way there, see lift_over
};

/// What is done in which order by which hand: goals of the scenario, stage by stage, through the
/// portals that its `through` goals name. A function of (plan, case, skill).
struct TourPlan {
  std::vector<TourTool> tools;
  std::vector<TourVisit> visits;
  std::vector<std::string> unreachable;
  std::map<std::string, double> fault_numbers;
  std::optional<TourPlace> blind;  ///< of the fault of looking away: no mark is in the picture
};
TourPlan plan_tour(const ScenarioPlan& plan, const Case& the_case, const Skill& skill,
                   std::vector<TourTool> tools);

/// How far a tour is; shared by its hands.
struct TourProgress {
  std::size_t at = 0;  ///< in TourPlan::visits
};

/// One hand of a tour: waits for its turn, draws back to the portal, turns about it, goes in, and
/// looks or touches. A change of portal goes over the skin. A function of (plan, skill, forces).
class TourHand : public HandPlayer {
 public:
  TourHand(std::shared_ptr<const TourPlan> plan, std::shared_ptr<TourProgress> progress,
           std::size_t hand, const Skill& skill);

  Pose start() const override;
  Pose step(double dt_s) override;
  void feel(const Vec3& force_W) override;
  bool done() const override;
  const std::vector<std::string>& unreachable() const override;

 private:
  enum class Phase { kWait, kBack, kOver, kTurn, kEnter, kLook, kPress, kFault };
  void enter(Phase phase);
  void move(double dt_s);
  void go_on();
  bool go_deep(double depth_m, double metres);
  void press(double dt_s);
  void fault(double dt_s);
  Vec3 tremor() const;
  const TourTool& tool() const { return plan_->tools[hand_]; }
  const TourVisit& visit() const { return plan_->visits[progress_->at]; }

  std::shared_ptr<const TourPlan> plan_;
  std::shared_ptr<TourProgress> progress_;
  std::size_t hand_;
  Skill skill_;
  std::array<double, 6> phases_{};
  TourPlace place_, from_;
  bool inside_ = false;
  Phase phase_ = Phase::kWait;
  double phase_s_ = 0, time_s_ = 0, pressed_s_ = 0, yielded_s_ = -1;
  std::deque<double> felt_n_;
  double known_n_ = 0, dt_s_ = 0.001;
};

}  // namespace osteon
