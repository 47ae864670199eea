#pragma once

#include <ctime>

#include <cstdint>

namespace osteon::test {

/// Computing time of this thread so far, ns: other programs on a busy machine do not count.
inline std::int64_t cpu_now_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1'000'000'000 + t.tv_nsec;
}

}  // namespace osteon::test
