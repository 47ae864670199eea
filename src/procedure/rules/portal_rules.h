#pragma once

#include <optional>
#include <vector>

#include "osteon/procedure/scenario.h"
#include "rules/rules.h"

namespace osteon {

/// Rules about portals that are made in skin (portal_watch.h).
const std::vector<RuleKind>& portal_rule_table();

/// Whether the rule is one of them; then `hit` is what the event makes of it. `place`: of the
/// event's landmark among the rule's.
bool step_portal_rule(const PlannedRule& rule, const Event& event, std::size_t place, double tick_s,
                      RuleState& state, std::optional<RuleHit>& hit);

}  // namespace osteon
