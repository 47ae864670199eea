#pragma once

#include <cstdint>

namespace osteon::testing {

/// What this thread has taken from the heap by `new` since it began. A program that asks has
/// count_allocations.cpp among its sources.
std::uint64_t allocations();

}  // namespace osteon::testing
