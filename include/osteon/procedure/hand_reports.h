#pragma once

#include <span>
#include <string>

#include "osteon/procedure/attempt.h"
#include "osteon/procedure/report.h"

namespace osteon {

/// Reports of the hands of one run: what is common at the top, the rest under `hands.<name>`:
/// ```
/// { "case": ..., "case_hash": ..., "duration_s": ..., "ticks": ...,
///   "hands": { "left": { "bones": {...}, "path_length_mm": ..., "smoothness_sparc": ... }, ... },
///   "state_hash": ..., "tick_us": {...}, "missed_ticks": ..., "realtime_factor": ... }
/// ```
/// As many names as reports, at least one.
std::string to_json(std::span<const Report> reports, std::span<const std::string> names);
/// The report of an attempt (attempt.h), whose keys tell of the first hand; of several hands with
/// each one's own bones, portals and way under `hands.<name>` as well.
std::string to_json(std::span<const Report> reports, std::span<const std::string> names,
                    const Outcome& outcome);

}  // namespace osteon
