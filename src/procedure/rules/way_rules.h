#pragma once

#include <cstddef>
#include <optional>

#include "rules/rules.h"

namespace osteon {

// Rules about where the tip goes, and what it removes; see rule_table().

/// A mark counts once the tip has stayed near it for long enough, after those before it.
std::optional<RuleHit> reached_in_order(const PlannedRule&, const Event&, std::size_t,
                                        double tick_s, RuleState&);
/// A pair counts once the tip has crossed the plane of its first mark near it and, without coming
/// back or aside, that of its second; both planes stand across the way from one to the other.
std::optional<RuleHit> passed_in_order(const PlannedRule&, const Event&, std::size_t, double tick_s,
                                       RuleState&);
std::optional<RuleHit> removed(const PlannedRule&, const Event&, std::size_t, double tick_s,
                               RuleState&);
std::optional<RuleHit> strayed(const PlannedRule&, const Event&, std::size_t, double tick_s,
                               RuleState&);
std::optional<RuleHit> passed_out_of_order(const PlannedRule&, const Event&, std::size_t,
                                           double tick_s, RuleState&);
std::optional<RuleHit> cut_outside(const PlannedRule&, const Event&, std::size_t, double tick_s,
                                   RuleState&);

}  // namespace osteon
