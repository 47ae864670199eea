#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/procedure/attempt.h"

namespace osteon {

/// A part of an exercise: somebody else has done the stages before it.
struct AttemptPart {
  std::string from, to;         ///< names of its first and last stage
  std::uint64_t from_tick = 0;  ///< the last tick that was done by somebody else
  bool operator==(const AttemptPart&) const = default;
};

/// Its stages' places in a scenario. Fails where the scenario lacks one, where the part ends before
/// it begins, and where its first one is neither the scenario's nor one to whose start one comes
/// back.
struct PartStages {
  std::uint32_t first = 0, last = 0;
};
Result<PartStages> stages_of(const AttemptPart& part, const Scenario& scenario);

/// What of an exercise's plan and state is about the part alone: its stages, its errors, and times
/// since its begin at `from_s`.
struct PartOfAttempt {
  ScenarioPlan plan;
  ScenarioState state;
};
PartOfAttempt part_of(const ScenarioPlan& plan, const ScenarioState& state, PartStages stages,
                      double from_s);

/// As a recording's note: "tibial_tunnel femoral_socket 402117".
std::string to_text(const AttemptPart& part);
/// Fails on what is not such a text.
Result<AttemptPart> parse_part(std::string_view text, const std::string& where);

}  // namespace osteon
