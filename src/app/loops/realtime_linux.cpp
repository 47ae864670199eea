// Linux only; realtime_portable.cpp takes its place elsewhere (see module.cmake).
#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>

#include "loops/realtime.h"

namespace osteon {
namespace {
// Above the kernel's threaded interrupts would starve the device's own driver (they run at 50).
constexpr int kHapticPriority = 40;
constexpr int kEarlyTurns = -10;
constexpr int kLateTurns = 10;
}  // namespace

bool request_priority() {
  sched_param param{};
  param.sched_priority = kHapticPriority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
}

bool request_early_turns() {
  // Who is 0: on Linux the calling thread alone, not its process.
  return setpriority(PRIO_PROCESS, 0, kEarlyTurns) == 0;
}

// A program that was started with a real-time priority gave it to this thread as well.
void take_late_turns() {
  const sched_param ordinary{};
  (void)pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
  (void)setpriority(PRIO_PROCESS, 0, kLateTurns);
}

bool lock_memory() {
  // Under a finite limit MCL_FUTURE would make later allocations fail: better paged than broken.
  rlimit limit{};
  if (getrlimit(RLIMIT_MEMLOCK, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY) return false;
  return mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
}

RealtimeLimits realtime_limits() {
  RealtimeLimits out;
  rlimit limit{};
  if (getrlimit(RLIMIT_RTPRIO, &limit) == 0)
    out.priority = limit.rlim_cur == RLIM_INFINITY ? "unlimited" : std::to_string(limit.rlim_cur);
  if (getrlimit(RLIMIT_MEMLOCK, &limit) == 0) {
    out.memory_unlimited = limit.rlim_cur == RLIM_INFINITY;
    out.memory =
        out.memory_unlimited ? "unlimited" : std::to_string(limit.rlim_cur / 1024) + " KiB";
  }
  return out;
}

void sleep_until_ns(std::int64_t deadline_ns) {
  timespec until{};
  until.tv_sec = static_cast<time_t>(deadline_ns / 1'000'000'000);
  until.tv_nsec = static_cast<long>(deadline_ns % 1'000'000'000);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace osteon
