#pragma once

#include <cstdint>
#include <string>

namespace osteon {

/// What the system granted to a loop that must keep time.
struct RealtimeGrant {
  bool priority = false;       ///< runs before ordinary threads
  bool memory_locked = false;  ///< the program's memory is never paged out
  std::string warning;  ///< what was refused, what it means and what to do; empty when all is
};

/// Asks for a real-time priority for the calling thread.
bool request_priority();
/// Asks that the calling thread, an ordinary one, gets its turn before other ordinary threads.
bool request_early_turns();
/// From now on the calling thread and those that it starts let other ordinary threads go first.
void take_late_turns();
/// Asks that the program's memory stays in RAM.
bool lock_memory();
/// Words for what was refused.
RealtimeGrant describe_grant(bool priority, bool memory_locked);

/// What this user may ask for, in words; "unknown" where the system does not tell.
struct RealtimeLimits {
  std::string priority = "unknown";  ///< highest real-time priority
  std::string memory = "unknown";    ///< that may be locked
  bool memory_unlimited = false;
};
RealtimeLimits realtime_limits();

/// Sleeps until `steady_now_ns` reaches `deadline_ns`; returns at once when that is past.
void sleep_until_ns(std::int64_t deadline_ns);

}  // namespace osteon
