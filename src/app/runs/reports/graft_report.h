#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "osteon/base/result.h"
#include "osteon/scene/graft_bench.h"

namespace osteon {

/// What was made at a bench.
struct GraftReport {
  GraftBenchPlan plan;
  GraftBenchState state;
};

/// docs/acl.md names the keys; lengths in mm.
nlohmann::ordered_json to_json(const GraftReport& report);
std::string to_text(const GraftReport& report);

/// What a knee needs to know of a graft that was made.
struct MadeGraft {
  double length_m = 0, diameter_m = 0, loop_m = 0;
  double creep_s = 0;  ///< how long it was pretensioned, as if at 80 N
};
/// Reads it from a report of `osteon run acl_graft`, or from its section `acl.graft`. Says which
/// key is missing or wrong.
Result<MadeGraft> made_graft(const std::string& json_text, const std::string& where);

}  // namespace osteon
