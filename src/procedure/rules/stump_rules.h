#pragma once

#include <optional>
#include <vector>

#include "rules/rules.h"

namespace osteon {

/// Rules about what a torn ligament has left, and about what is beside it.
const std::vector<RuleKind>& stump_rule_table();
/// False: the rule is none of these.
bool step_stump_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                     std::optional<RuleHit>& hit);

}  // namespace osteon
