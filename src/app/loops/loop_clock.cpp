#include "loops/loop_clock.h"

#include <cmath>

#include "loops/realtime.h"
#include "osteon/base/clock.h"

namespace osteon {
namespace {
constexpr std::int64_t kWindowNs = 250'000'000;
}

LoopClock::LoopClock(double period_s)
    : pacer_(static_cast<std::int64_t>(std::llround(period_s * 1e9))) {
  window_started_ns_ = steady_now_ns();
  pacer_.start(window_started_ns_);
}

void LoopClock::wait() {
  sleep_until_ns(pacer_.next(steady_now_ns()));
  tick_started_ns_ = steady_now_ns();
}

bool LoopClock::tick_done() {
  const std::int64_t now = steady_now_ns();
  durations_.add_ns(now - tick_started_ns_);
  ++stats_.ticks;
  ++window_ticks_;
  if (now - window_started_ns_ < kWindowNs) return false;
  refresh(now);
  return true;
}

void LoopClock::refresh(std::int64_t now_ns) {
  const double window_s = static_cast<double>(now_ns - window_started_ns_) * 1e-9;
  stats_.rate_hz = static_cast<double>(window_ticks_) / window_s;
  stats_.missed = pacer_.missed();
  stats_.p50_us = durations_.quantile_ns(0.50) * 1e-3;
  stats_.p99_us = durations_.quantile_ns(0.99) * 1e-3;
  stats_.p999_us = durations_.quantile_ns(0.999) * 1e-3;
  stats_.max_us = durations_.max_ns() * 1e-3;
  window_started_ns_ = now_ns;
  window_ticks_ = 0;
}

}  // namespace osteon
