#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "osteon/base/bounded_queue.h"
#include "osteon/record/recording.h"

namespace osteon {

/// Carries records from the loops to the file. Each loop pushes into its own queue and never waits;
/// `drain`, on another thread, writes what has come. When a queue is full or the file fails, the
/// recording ends there and says so; the simulation goes on.
///
/// The file always holds a run that can be repeated: a tick is written once the physics step and
/// the other hands' ticks that it consumed are, and a step once the ticks that it consumed are.
class RecordFeed {
 public:
  /// Room for `seconds` of ticks while the disk is busy.
  explicit RecordFeed(RecordingWriter writer, double seconds = 30.0, std::size_t hands = 1);

  /// From a hand's loop, from the physics loop: no lock, no allocation. Of events, those that find
  /// no room are left out: a replay makes them again.
  void push(std::size_t hand, const TickRecord& record, std::span<const Event> events = {}) {
    if (hand >= hands_.size() || !hands_[hand]) return;
    for (const Event& event : events) hands_[hand]->events.push(event);
    push_to(hands_[hand]->ticks, record);
  }
  void push(const TickRecord& record) { push(0, record); }
  void push(const StepRecord& record) { push_to(steps_, record); }

  /// From one other thread: writes what has come. Returns how many records.
  std::size_t drain();
  /// From that thread too.
  void add(const StoredState& state);
  /// After all loops have stopped: writes the rest and closes the file.
  Result<void> finish();

  /// Why the recording ended early; empty while all is well. From any thread.
  std::string early_end() const;
  /// Of the first hand.
  std::uint64_t ticks_written() const { return hands_[0]->written.load(std::memory_order_relaxed); }

 private:
  struct Hand {
    explicit Hand(std::size_t capacity) : ticks(capacity), events(capacity / 4 + 64) {}
    BoundedQueue<TickRecord> ticks;
    BoundedQueue<Event> events;
    std::optional<TickRecord> next;
    std::atomic<std::uint64_t> written{0};
  };
  template <class T>
  void push_to(BoundedQueue<T>& queue, const T& record) {
    if (ended_.load(std::memory_order_relaxed)) return;
    if (queue.push(record)) return;
    overflowed_.store(true, std::memory_order_relaxed);
    ended_.store(true, std::memory_order_relaxed);
  }
  bool has_written(std::span<const std::uint64_t, kMaxHands> ticks) const;
  bool write_next_tick(std::size_t hand);
  bool write_next_step();
  void write_events(Hand& hand);
  void fail_with(std::string message);

  RecordingWriter writer_;
  std::array<std::unique_ptr<Hand>, kMaxHands> hands_;
  BoundedQueue<StepRecord> steps_;
  std::optional<StepRecord> next_step_;
  std::uint64_t steps_written_ = 0;
  std::atomic<bool> ended_{false};
  std::atomic<bool> overflowed_{false};
  std::atomic<bool> failed_{false};  ///< set once, after failure_ has its text
  std::string failure_;
};

}  // namespace osteon
