#include "loops/stop_signal.h"

#include <signal.h>
#include <time.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <exception>

namespace osteon {
namespace {

// A signal handler has no argument of its own: this is the one thing it may write to.
std::atomic<int> g_requested{0};
static_assert(std::atomic<int>::is_always_lock_free);

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};
constexpr int kTerminating = -1;

extern "C" void request_stop(int number) {
  g_requested.store(number);
  signal(number, SIG_DFL);  // the second one kills
}

// The loops see the request within a tick; 50 ms are many.
[[noreturn]] void stop_then_abort() {
  g_requested.store(kTerminating);
  const timespec moment{0, 50'000'000};
  nanosleep(&moment, nullptr);
  std::abort();
}

}  // namespace

StopSignals::StopSignals() {
  g_requested.store(0);
  for (const int number : kSignals) signal(number, request_stop);
  std::set_terminate(stop_then_abort);
}

StopSignals::~StopSignals() {
  for (const int number : kSignals) signal(number, SIG_DFL);
  std::set_terminate(std::abort);
}

bool stop_requested() { return g_requested.load(std::memory_order_relaxed) != 0; }

int stop_signal() {
  const int number = g_requested.load();
  return number > 0 ? number : 0;
}

}  // namespace osteon
