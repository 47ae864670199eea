#pragma once

#include <cstddef>
#include <optional>

#include "rules/rules.h"

namespace osteon {

// Rules about loose rings; see rule_table().

/// A mark counts while more rings have been left on its peg than taken from it.
std::optional<RuleHit> ringed(const PlannedRule&, const Event&, std::size_t, double tick_s,
                              RuleState&);
std::optional<RuleHit> ring_dropped(const PlannedRule&, const Event&, std::size_t, double tick_s,
                                    RuleState&);

}  // namespace osteon
