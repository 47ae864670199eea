#pragma once

#include <optional>
#include <vector>

#include "osteon/procedure/scenario.h"
#include "rules/rules.h"

namespace osteon {

/// Rules about a cut in skin that is there for no portal (kSkinOpened).
const std::vector<RuleKind>& skin_rule_table();

/// Whether the rule is one of them; then `hit` is what the event makes of it.
bool step_skin_rule(const PlannedRule& rule, const Event& event, double tick_s, RuleState& state,
                    std::optional<RuleHit>& hit);

}  // namespace osteon
