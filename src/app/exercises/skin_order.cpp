#include "exercises/skin_order.h"

#include <algorithm>
#include <utility>

namespace osteon {
namespace {

bool has_goal_of(const ScenarioStage& stage, const std::string& kind) {
  return std::any_of(stage.goals.begin(), stage.goals.end(),
                     [&](const Rule& goal) { return goal.kind == kind; });
}

}  // namespace

std::optional<std::uint32_t> stage_bent_after_portals(const ScenarioPlan& plan) {
  const auto& stages = plan.scenario.stages;
  bool portals = false;
  for (std::uint32_t s = 0; s < stages.size(); ++s) {
    portals = portals || has_goal_of(stages[s], "portal_made");
    if (portals && has_goal_of(stages[s], "knee_bent")) return s;
  }
  return std::nullopt;
}

bool is_skin_of_portals(const std::string& soft) {
  return soft == "skin" || soft.starts_with("skin:portal_");
}

bool is_skin_elsewhere(const std::string& soft) {
  return soft.starts_with("skin:") && !is_skin_of_portals(soft);
}

bool opens_skin(const ScenarioStage& stage) { return has_goal_of(stage, "skin_opened"); }

std::optional<std::uint32_t> stage_after_incision(const ScenarioPlan& plan) {
  const auto& stages = plan.scenario.stages;
  for (std::size_t s = stages.size(); s > 0; --s)
    if (opens_skin(stages[s - 1])) return static_cast<std::uint32_t>(s);
  return std::nullopt;
}

// All from the first of them until the knee is bent after the last one.
void leave_out_puncture_stages(Scenario& scenario) {
  auto& stages = scenario.stages;
  const auto makes = [](const ScenarioStage& stage) { return has_goal_of(stage, "portal_made"); };
  const auto first = std::find_if(stages.begin(), stages.end(), makes);
  auto end = std::find_if(stages.rbegin(), stages.rend(), makes).base();
  const auto bent = std::find_if(end, stages.end(), [](const ScenarioStage& stage) {
    return has_goal_of(stage, "knee_bent");
  });
  if (bent != stages.end()) end = bent + 1;
  if (first != stages.end()) stages.erase(first, end);
  std::erase_if(scenario.soft, is_skin_of_portals);
}

void SkinOrder::see(const ScenarioPlan& plan, const ScenarioState& state, std::uint32_t epoch) {
  if (std::exchange(epoch_, epoch) != epoch) told_ = 0;
  const auto has_come = [&](std::optional<std::uint32_t> stage) {
    return stage && state.stage >= *stage;
  };
  const int bare = has_come(stage_after_incision(plan))       ? 2
                   : has_come(stage_bent_after_portals(plan)) ? 1
                                                              : 0;
  waiting_ = waiting_ || bare > told_;
  told_ = std::max(told_, bare);
}

std::optional<Command> SkinOrder::take() {
  if (!std::exchange(waiting_, false)) return std::nullopt;
  return Command{CommandKind::kBareSkin, told_ == 2 ? 1.0 : 0.0};
}

}  // namespace osteon
