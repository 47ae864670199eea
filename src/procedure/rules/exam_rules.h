#pragma once

#include <optional>
#include <vector>

#include "rules/rules.h"

namespace osteon {

/// Rules about a knee that is examined by hand.
const std::vector<RuleKind>& exam_rule_table();
/// False: the rule is none of these.
bool step_exam_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                    std::optional<RuleHit>& hit);

}  // namespace osteon
