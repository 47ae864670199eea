#pragma once

#include <optional>

#include "exercises/number_teller.h"
#include "osteon/procedure/judge.h"
#include "osteon/scene/command.h"
#include "osteon/scene/placing.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Whether a scenario has a graft placed.
bool asks_for_graft(const ScenarioPlan& plan);

/// Whether the goals of a stage are about a graft that is made at a bench.
bool is_at_bench(const ScenarioStage& stage);
/// Where the work of a stage is done: in the joint, on skin that is there for no portal, at a bench
/// where tendons are found under their fascia, or at the rest of it.
enum class WorkPlace { kJoint, kSkin, kFascia, kBench };
WorkPlace place_of_work(const ScenarioStage& stage);
/// Leaves out the stages in which a graft is made at a bench: for one that was made before.
void leave_out_bench_stages(Scenario& scenario);

/// Hands a graft over to a session whose tunnels were drilled and measured, by commands that are
/// recorded: again where it does not come, and anew where the tunnels have changed before a thread
/// lies in them. After a restore point from before the graft it comes once more.
class GraftOrder {
 public:
  /// `wanted`: what was measured; none: there are no two tunnels, or they are not known yet.
  void see(const std::optional<PlacingPlan>& wanted, const BoneSnapshot& bones);
  /// The next command for the physics; none: there is nothing to say. One a physics step.
  std::optional<Command> take() { return teller_.take(); }

 private:
  NumberTeller teller_{CommandKind::kGraftOrder, CommandKind::kGraftNumber};
};

}  // namespace osteon
