#pragma once

#include <optional>
#include <vector>

#include "rules/rules.h"

namespace osteon {

/// Kinds of rules about a graft that is placed by hand.
const std::vector<RuleKind>& placing_rule_table();

/// Steps a rule of these kinds; false: it is of another.
bool step_placing_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                       std::optional<RuleHit>& hit);

}  // namespace osteon
