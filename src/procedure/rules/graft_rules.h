#pragma once

#include <optional>
#include <vector>

#include "rules/rules.h"

namespace osteon {

/// Kinds of rules about a graft that is made at a bench.
const std::vector<RuleKind>& graft_rule_table();

/// Takes an event into account, as step_rule does; false: the kind is none of these.
bool step_graft_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                     std::optional<RuleHit>& hit);

}  // namespace osteon
