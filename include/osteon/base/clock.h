#pragma once

#include <cstdint>

namespace osteon {

/// Monotonic time, ns. For measuring and pacing only: no simulation step reads it.
std::int64_t steady_now_ns();

}  // namespace osteon
