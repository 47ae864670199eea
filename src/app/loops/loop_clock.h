#pragma once

#include <cstdint>

#include "loops/loop_exchange.h"
#include "loops/tick_pacer.h"
#include "osteon/base/percentiles.h"

namespace osteon {

/// Paces one loop by the monotonic clock and measures it. Used by the loop's thread alone;
/// allocates nothing.
class LoopClock {
 public:
  explicit LoopClock(double period_s);
  /// Sleeps until the next tick is due.
  void wait();
  /// Call after each tick; true four times a second, when `stats` is new.
  bool tick_done();
  const LoopStats& stats() const { return stats_; }

 private:
  void refresh(std::int64_t now_ns);

  TickPacer pacer_;
  Percentiles durations_;
  LoopStats stats_;
  std::int64_t tick_started_ns_ = 0;
  std::int64_t window_started_ns_ = 0;
  std::uint64_t window_ticks_ = 0;
};

}  // namespace osteon
