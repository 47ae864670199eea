// For systems without POSIX real-time scheduling; left out of the build on Linux (module.cmake).
#include <chrono>
#include <thread>

#include "loops/realtime.h"

namespace osteon {

bool request_priority() { return false; }
bool request_early_turns() { return false; }
void take_late_turns() {}
bool lock_memory() { return false; }
RealtimeLimits realtime_limits() { return {}; }

void sleep_until_ns(std::int64_t deadline_ns) {
  using Clock = std::chrono::steady_clock;
  std::this_thread::sleep_until(Clock::time_point(
      std::chrono::duration_cast<Clock::duration>(std::chrono::nanoseconds(deadline_ns))));
}

}  // namespace osteon
