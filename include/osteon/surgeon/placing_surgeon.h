#pragma once

#include <string>

#include "osteon/base/result.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// The way of the hand that places a graft: the passing pin through the femoral socket until the
/// thread's end lies in the joint, a grasper through the tibia takes it out, a clamp at the thread
/// draws the graft in and lets go a few mm after the button is out. A beginner is slower and
/// trembles more. `skill` "bad:NAME" does one thing wrong: lost_thread, unflipped_button,
/// soft_tissue, flipped_in_muscle. Fails on another NAME and where the case has no tunnels for a
/// graft.
Result<ProbePath> plan_graft_placing(const Case& the_case, const Skill& skill);

/// The way of a scope that comes in by a portal and looks on between both mouths. Fails as above.
Result<ProbePath> plan_placing_scope(const Case& the_case, const Vec3& portal_W,
                                     const std::string& instrument);

}  // namespace osteon
