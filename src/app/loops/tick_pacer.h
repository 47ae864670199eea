#pragma once

#include <cstdint>

namespace osteon {

/// Deadlines of a loop with a fixed period. A deadline that is already past by a whole period or
/// more is skipped and counted: a late loop does not run a burst of ticks to catch up. Reads no
/// clock: the caller says what time it is.
class TickPacer {
 public:
  explicit TickPacer(std::int64_t period_ns) : period_ns_(period_ns) {}
  void start(std::int64_t now_ns) { deadline_ns_ = now_ns; }
  /// Deadline of the next tick, ns on the caller's clock.
  std::int64_t next(std::int64_t now_ns);
  std::uint64_t missed() const { return missed_; }

 private:
  std::int64_t period_ns_;
  std::int64_t deadline_ns_ = 0;
  std::uint64_t missed_ = 0;
};

}  // namespace osteon
