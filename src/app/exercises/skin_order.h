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

/// Whether what a scenario names as soft is skin in which portals are made.
bool is_skin_of_portals(const std::string& soft);
/// Whether it is skin that is there for no portal.
bool is_skin_elsewhere(const std::string& soft);

/// Whether skin is to be opened in a stage, elsewhere than for a portal.
bool opens_skin(const ScenarioStage& stage);

/// The first stage after those in which skin is opened elsewhere than for a portal; none: in no
/// stage it is.
std::optional<std::uint32_t> stage_after_incision(const ScenarioPlan& plan);

/// Tells a session that skin is felt no more, by commands that are recorded: that about portals
/// when the stage begins in which the knee is bent after they were made, for skin is laid on one
/// bend alone; the rest when the stages are over in which it is opened.
class SkinOrder {
 public:
  /// `epoch`: of the bones. After a restore point it is told again: skin may be felt again.
  void see(const ScenarioPlan& plan, const ScenarioState& state, std::uint32_t epoch);
  /// The next command for the physics; none: there is nothing to say.
  std::optional<Command> take();

 private:
  int told_ = 0;  ///< 1: of portals, 2: of all
  bool waiting_ = false;
  std::uint32_t epoch_ = 0;
};

}  // namespace osteon
