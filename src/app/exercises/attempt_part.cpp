#include "exercises/attempt_part.h"

#include <algorithm>
#include <sstream>

namespace osteon {
namespace {

Result<std::uint32_t> stage_called(const std::string& name, const Scenario& scenario) {
  std::string names;
  for (std::uint32_t i = 0; i < scenario.stages.size(); ++i) {
    if (scenario.stages[i].name == name) return i;
    names += (names.empty() ? "" : ", ") + scenario.stages[i].name;
  }
  return fail("the exercise '" + scenario.name + "' has no stage '" + name + "'", "",
              "Its stages are: " + names);
}

}  // namespace

Result<PartStages> stages_of(const AttemptPart& part, const Scenario& scenario) {
  const auto first = stage_called(part.from, scenario), last = stage_called(part.to, scenario);
  if (!first || !last) return tl::unexpected(first ? last.error() : first.error());
  if (*last < *first)
    return fail("the stage '" + part.to + "' comes before '" + part.from + "'", "",
                "End with the same stage or a later one");
  // The first stage begins where the exercise does.
  if (*first > 0 && !scenario.stages[*first].restore_point)
    return fail("the exercise '" + scenario.name + "' cannot begin at its stage '" + part.from +
                "', which has no restore point");
  return PartStages{*first, *last};
}

PartOfAttempt part_of(const ScenarioPlan& plan, const ScenarioState& state, PartStages stages,
                      double from_s) {
  PartOfAttempt part{plan, state};
  const auto cut = [&](auto& list) {
    const std::size_t end = std::min<std::size_t>(stages.last + 1, list.size());
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(end), list.end());
    list.erase(list.begin(),
               list.begin() + std::min<std::ptrdiff_t>(stages.first, std::ssize(list)));
  };
  const bool ends_early = stages.last + 1 < plan.scenario.stages.size();
  cut(part.plan.scenario.stages);
  cut(part.plan.goals);
  cut(part.state.completed_s);
  for (double& at_s : part.state.completed_s)
    if (at_s >= 0) at_s = std::max(0.0, at_s - from_s);
  // What a later stage would have come to is not left out.
  std::erase_if(part.state.errors, [&](const MadeError& made) {
    return made.at_s <= from_s || (ends_early && plan.errors[made.error].rule.kind == "left_out");
  });
  for (MadeError& made : part.state.errors) made.at_s -= from_s;
  part.state.stage = state.stage > stages.first ? state.stage - stages.first : 0;
  return part;
}

std::string to_text(const AttemptPart& part) {
  return part.from + " " + part.to + " " + std::to_string(part.from_tick) + "\n";
}

Result<AttemptPart> parse_part(std::string_view text, const std::string& where) {
  std::istringstream words{std::string(text)};
  AttemptPart part;
  std::string rest;
  if (!(words >> part.from >> part.to >> part.from_tick) || words >> rest)
    return fail("its note about the part that was played is damaged", where,
                "Use another copy of the file");
  return part;
}

}  // namespace osteon
