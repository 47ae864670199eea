#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/support/headless.h"
#include "commands/teaching/scenario_run.h"
#include "exercises/attempt_watch.h"
#include "exercises/tunnel_watch.h"
#include "osteon/surgeon/hand_player.h"

namespace osteon {

/// What the hand that drills goes by later, while the session runs.
struct LaterWork {
  std::function<const BoneSnapshot*()> bones;      ///< as they are; null before the session begins
  std::function<std::optional<GraftRoom>()> room;  ///< of the tunnels, once they are measured
  bool made = false;                               ///< the graft is made within the exercise
};

/// The hands of a virtual surgeon who reconstructs a ligament, into `headless`, and who plays them,
/// into `players`. What is handed over must outlive the run. Gives the names of what the surgeon
/// found no way to.
Result<std::vector<std::string>> plan_reconstruction(
    const ScenarioRun& run, const ScenarioPlan& plan, const Case& the_case,
    std::span<const PlannedHand> hands, LaterWork work, HeadlessRun& headless,
    std::vector<std::unique_ptr<HandPlayer>>& players);

}  // namespace osteon
