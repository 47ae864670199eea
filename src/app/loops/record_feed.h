#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "osteon/base/bounded_queue.h"
#include "osteon/record/recording.h"

namespace osteon {

/// Carries records from the two loops to the file. Each loop pushes into its own queue and never
/// waits; `drain`, on a third thread, writes what has come. When a queue is full or the file fails,
/// the recording ends there and says so; the simulation goes on.
///
/// The file always holds a run that can be repeated: a tick is written once the physics step that
/// it consumed is, and a step once the tick that it consumed is.
class RecordFeed {
 public:
  /// Room for `seconds` of ticks while the disk is busy.
  explicit RecordFeed(RecordingWriter writer, double seconds = 8.0);

  /// From the haptic loop, from the physics loop: no lock, no allocation.
  void push(const TickRecord& record) { push_to(ticks_, record); }
  void push(const StepRecord& record) { push_to(steps_, record); }

  /// From one other thread: writes what has come. Returns how many records.
  std::size_t drain();
  /// After both loops have stopped: writes the rest and closes the file.
  Result<void> finish();

  /// Why the recording ended early; empty while all is well. From any thread.
  std::string early_end() const;
  std::uint64_t ticks_written() const { return ticks_written_.load(std::memory_order_relaxed); }

 private:
  template <class T>
  void push_to(BoundedQueue<T>& queue, const T& record) {
    if (ended_.load(std::memory_order_relaxed)) return;
    if (queue.push(record)) return;
    overflowed_.store(true, std::memory_order_relaxed);
    ended_.store(true, std::memory_order_relaxed);
  }
  bool write_next_tick();
  bool write_next_step();
  void fail_with(std::string message);

  RecordingWriter writer_;
  BoundedQueue<TickRecord> ticks_;
  BoundedQueue<StepRecord> steps_;
  std::optional<TickRecord> next_tick_;
  std::optional<StepRecord> next_step_;
  std::uint64_t steps_written_ = 0;
  std::atomic<std::uint64_t> ticks_written_{0};
  std::atomic<bool> ended_{false};
  std::atomic<bool> overflowed_{false};
  std::atomic<bool> failed_{false};  ///< set once, after failure_ has its text
  std::string failure_;
};

}  // namespace osteon
