#pragma once

#include <cstdint>

namespace osteon::testing {

/// How often this thread has locked a mutex, or written to a file, a pipe or a terminal, so far.
/// Counts in programs that are built with count_locks.cpp, and not under a sanitizer, which has its
/// own hands on these calls.
std::uint64_t locks();
std::uint64_t writes();
bool counts_locks();

}  // namespace osteon::testing
