#pragma once

#include <string_view>

#include "osteon/procedure/scenario.h"

namespace osteon {

/// Whether the rule is about what a hand does with that instrument, as a tray names it: its size is
/// left out.
bool is_of(const Rule& rule, std::string_view instrument);

/// Whether a hand that the rule means may take an instrument of that name.
bool is_in_tray(const Scenario& scenario, const Rule& rule, std::string_view instrument);

}  // namespace osteon
