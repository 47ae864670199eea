#pragma once

#include "osteon/base/result.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// The way of one hand that makes a graft at a bench: all bands cut, both tendons stripped, folded
/// to as few strands as make 8 mm and 75 mm, sized, kept at about 80 N for ten minutes of the
/// board's clock, hung on the shortest loop with which the button turns. A beginner is slower and
/// trembles more. `skill` "bad:NAME" does one thing wrong: amputated_tendon, unflipped_button,
/// long_loop, slack_graft. Fails on another NAME and where the case has no bench.
Result<ProbePath> plan_graft(const Case& the_case, const Skill& skill);

}  // namespace osteon
