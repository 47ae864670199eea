#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "osteon/procedure/judge.h"
#include "osteon/scene/command.h"

namespace osteon {

/// The first stage after its portals in which a scenario has the knee bent; none: there is none.
std::optional<std::uint32_t> stage_bent_after_portals(const ScenarioPlan& plan);

/// Leaves out the stages in which portals are made, and the patches of skin that are for them: for
/// portals that were made before.
void leave_out_puncture_stages(Scenario& scenario);

/// Tells a session that skin is felt no more once its portals are made, by a command that is
/// recorded: when the stage begins in which the knee is bent after that, for skin is laid on one
/// bend alone.
class SkinOrder {
 public:
  /// `epoch`: of the bones. After a restore point it is told again: skin may be felt again.
  void see(const ScenarioPlan& plan, const ScenarioState& state, std::uint32_t epoch);
  /// The next command for the physics; none: there is nothing to say.
  std::optional<Command> take();

 private:
  bool told_ = false, waiting_ = false;
  std::uint32_t epoch_ = 0;
};

}  // namespace osteon
