#pragma once

#include <cstdint>
#include <string>

namespace osteon {

/// "2026-01-31T12:05:09.123Z" of milliseconds since 1970 (UTC); the same in every time zone.
std::string utc_text(std::int64_t ms);

}  // namespace osteon
