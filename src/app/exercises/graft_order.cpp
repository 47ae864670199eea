#include "exercises/graft_order.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "exercises/skin_order.h"

namespace osteon {
namespace {

bool has_come(const PlacingPlan& wanted, const GraftPlacingState& there) {
  return there.on && placing_numbers(there.plan) == placing_numbers(wanted);
}

bool in_use(const GraftPlacingState& there) {
  return there.on && (there.phase != PlacingPhase::kEmpty || there.pin_m > 0);
}

}  // namespace

bool asks_for_graft(const ScenarioPlan& plan) {
  for (const auto& goals : plan.goals)
    for (const PlannedRule& goal : goals)
      if (goal.rule.kind == "thread_laid" || goal.rule.kind == "button_turned") return true;
  return false;
}

bool is_at_bench(const ScenarioStage& stage) {
  constexpr std::array<std::string_view, 9> kOfBench{
      "fascia_opened", "tendons_found", "tendons_stripped", "muscle_off", "tendons_stitched",
      "graft_folded",  "graft_sized",   "graft_tensioned",  "loop_hung"};
  return std::any_of(stage.goals.begin(), stage.goals.end(), [&](const Rule& goal) {
    return std::find(kOfBench.begin(), kOfBench.end(), goal.kind) != kOfBench.end();
  });
}

WorkPlace place_of_work(const ScenarioStage& stage) {
  if (opens_skin(stage)) return WorkPlace::kSkin;
  if (!is_at_bench(stage)) return WorkPlace::kJoint;
  const bool finds = std::any_of(stage.goals.begin(), stage.goals.end(), [](const Rule& goal) {
    return goal.kind == "fascia_opened" || goal.kind == "tendons_found";
  });
  return finds ? WorkPlace::kFascia : WorkPlace::kBench;
}

// With them the skin is left whole through which the tendons would come.
void leave_out_bench_stages(Scenario& scenario) {
  if (std::erase_if(scenario.stages, opens_skin) > 0)
    std::erase_if(scenario.soft, is_skin_elsewhere);
  std::erase_if(scenario.stages, is_at_bench);
}

void GraftOrder::see(const std::optional<PlacingPlan>& wanted, const BoneSnapshot& bones) {
  const GraftPlacingState& there = bones.placing;
  teller_.look(bones.time_s);
  if (teller_.telling() || !wanted || has_come(*wanted, there) || in_use(there)) return;
  if (!teller_.under_way(bones.time_s)) teller_.tell(placing_numbers(*wanted), bones.time_s);
}

}  // namespace osteon
