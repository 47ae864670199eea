#pragma once

#include <string>

#include "osteon/base/result.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/scene/placing.h"
#include "osteon/surgeon/parts_hand.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// The way of the hand that places a graft: the passing pin through the femoral socket until the
/// thread's end lies in the joint, a grasper through the tibia takes it out, a clamp at the thread
/// draws the graft in and lets go a few mm after the button is out. A beginner is slower and
/// trembles more. `skill` "bad:NAME" does one thing wrong: lost_thread, unflipped_button,
/// soft_tissue, flipped_in_muscle. Fails on another NAME and where the case has no tunnels for a
/// graft.
Result<ProbePath> plan_graft_placing(const Case& the_case, const Skill& skill);

/// The same in a knee whose tunnels were drilled, from where the hand with what drilled them is. An
/// expert's but for the faults above.
ProbePath plan_graft_placing(const Case& the_case, const PlacingPlan& plan, const Skill& skill,
                             const Pose& from, const std::string& held);

/// What follows when the button has turned: the tail is pulled while the knee is stretched out and
/// bent 25 times, then pulled with 90 N at 30 degrees while the screw goes in beside the graft in
/// the tibia. `screw`: as the tray names it. `skill` "bad:NAME" does one thing wrong: few_cycles,
/// slack_tension, diverging_screw, shallow_screw. Fails where the case has no joint that bends.
Result<HandPart> plan_graft_fixing(const Case& the_case, const PlacingPlan& plan,
                                   const Skill& skill, const Pose& from, const std::string& held,
                                   const std::string& screw);

/// The way of a scope that comes in by a portal and looks on between both mouths. Fails as above.
Result<ProbePath> plan_placing_scope(const Case& the_case, const Vec3& portal_W,
                                     const std::string& instrument);

}  // namespace osteon
