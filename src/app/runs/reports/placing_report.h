#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "osteon/procedure/placing_watch.h"
#include "osteon/scene/placing.h"

namespace osteon {

/// How a graft was placed.
struct PlacingReport {
  PlacingPlan plan;
  GraftPlacingState state;
  BentGraft bent{};
};

/// docs/acl.md names the keys; lengths in mm.
nlohmann::ordered_json to_json(const PlacingReport& report);
std::string to_text(const PlacingReport& report);

}  // namespace osteon
