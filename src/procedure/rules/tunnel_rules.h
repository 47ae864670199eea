#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "rules/rules.h"

namespace osteon {

/// Kinds of rules about portals, landmarks felt, and tunnels located for a graft.
const std::vector<RuleKind>& tunnel_rule_table();

/// Takes an event into account, as step_rule does, which has found the subject; false: the kind is
/// none of these.
bool step_tunnel_rule(const PlannedRule& rule, const Event& event, std::size_t place, double tick_s,
                      RuleState& state, std::optional<RuleHit>& hit);

}  // namespace osteon
