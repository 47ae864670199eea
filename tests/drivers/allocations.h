#pragma once

#include <cstdint>

namespace osteon::testing {

/// What this thread has taken from the heap by `new` since it began. The counter itself is in
/// allocations_test.cpp: one a program.
std::uint64_t allocations();

}  // namespace osteon::testing
