#pragma once

#include <cstdint>
#include <string>

namespace osteon {

/// "2026-01-31T12:05:09.123Z" of milliseconds since 1970 (UTC); the same in every time zone.
std::string utc_text(std::int64_t ms);
/// "PT61.25S": ISO 8601, to a hundredth of a second; of less than nothing "PT0.00S".
std::string duration_text(double seconds);

}  // namespace osteon
