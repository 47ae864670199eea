#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "commands/teaching/scenario_run.h"
#include "exercises/attempt_watch.h"
#include "osteon/surgeon/acl_surgeon.h"
#include "osteon/surgeon/scripted_hand.h"

namespace osteon {

/// How a virtual surgeon makes the portals of a knee before he does anything else in it.
struct OpenedKnee {
  ProbePath scope, worker;
  std::vector<TimedCommand> orders;  ///< then the knee is bent as it lies at rest
  double end_s = 0;                  ///< when all of that is done
  bool erred = false;                ///< he made an error with the portals: nothing follows
  /// Landmarks that his scope cannot show meanwhile, or his hook not get to.
  std::vector<std::string> unreachable = {};
};
/// Landmarks of goals of this kind ("seen", "felt") that are to be met when the portals are made
/// and before the knee is bent.
std::vector<std::string> marks_before_bending(const ScenarioPlan& plan, std::string_view kind);

/// None: the scenario does not ask for portals. Puts into `tools` when what follows begins and
/// where the portals are then.
Result<std::optional<OpenedKnee>> plan_opening(const ScenarioPlan& plan, const Case& the_case,
                                               const Skill& skill, AclTools& tools);

/// One path after another, whose own beginning is a rest.
ProbePath joined(ProbePath first, const ProbePath& then);

}  // namespace osteon
