#include "loops/stop_signal.h"

#include <signal.h>
#include <time.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <exception>

namespace osteon {
namespace {

// A signal handler has no argument of its own: this is what it may write to and read.
std::atomic<int> g_requested{0};
std::atomic<int> g_loops_to_end{0};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
constexpr std::array kDeadly = {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
constexpr int kDying = -1;

extern "C" void request_stop(int number) {
  g_requested.store(number);
  signal(number, SIG_DFL);  // the second one kills
}

// Loops of the thread itself: when it dies, nobody else ends those.
thread_local int t_own_loops = 0;

// The loops see the request within a tick; 50 ms are many, but not on a busy machine. Three seconds
// end the wait for a device that never closes. Nothing but what a signal handler may do.
void let_loops_end() {
  constexpr int kAtLeast = 10, kAtMost = 600;
  g_requested.store(kDying);
  const timespec moment{0, 5'000'000};
  const int ends_never = t_own_loops;
  for (int k = 0; k < kAtLeast || (k < kAtMost && g_loops_to_end.load() > ends_never); ++k)
    nanosleep(&moment, nullptr);
}

extern "C" void end_loops_and_die(int number) {
  signal(number, SIG_DFL);
  let_loops_end();
  raise(number);
}

[[noreturn]] void end_loops_and_abort() {
  signal(SIGABRT, SIG_DFL);
  let_loops_end();
  std::abort();
}

// A sanitizer's handler knows better what to tell.
void catch_deadly(int number) {
  struct sigaction now {};
  const bool free = sigaction(number, nullptr, &now) == 0 && (now.sa_flags & SA_SIGINFO) == 0 &&
                    now.sa_handler == SIG_DFL;
  if (free) signal(number, end_loops_and_die);
}

void release_deadly(int number) {
  struct sigaction now {};
  const bool ours = sigaction(number, nullptr, &now) == 0 && (now.sa_flags & SA_SIGINFO) == 0 &&
                    now.sa_handler == end_loops_and_die;
  if (ours) signal(number, SIG_DFL);
}

}  // namespace

StopSignals::StopSignals() {
  g_requested.store(0);
  for (const int number : kSignals) signal(number, request_stop);
  for (const int number : kDeadly) catch_deadly(number);
  std::set_terminate(end_loops_and_abort);
}

StopSignals::~StopSignals() {
  for (const int number : kSignals) signal(number, SIG_DFL);
  for (const int number : kDeadly) release_deadly(number);
  std::set_terminate(std::abort);
}

LoopToEnd::LoopToEnd() {
  ++g_loops_to_end;
  ++t_own_loops;
}
LoopToEnd::~LoopToEnd() {
  --g_loops_to_end;
  --t_own_loops;
}

bool stop_requested() { return g_requested.load(std::memory_order_relaxed) != 0; }

int stop_signal() {
  const int number = g_requested.load();
  return number > 0 ? number : 0;
}

}  // namespace osteon
