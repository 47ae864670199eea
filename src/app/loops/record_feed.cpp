#include "loops/record_feed.h"

namespace osteon {
namespace {

std::size_t capacity(double seconds, double rate_hz) {
  return static_cast<std::size_t>(seconds * rate_hz);
}

}  // namespace

RecordFeed::RecordFeed(RecordingWriter writer, double seconds, std::size_t hands)
    : writer_(std::move(writer)), steps_(capacity(seconds, 1000.0)) {
  for (std::size_t h = 0; h < hands && h < kMaxHands; ++h)
    hands_[h] = std::make_unique<Hand>(capacity(seconds, 1000.0));
}

std::size_t RecordFeed::drain() {
  std::size_t written = 0;
  while (failure_.empty()) {
    std::size_t some = write_next_step() ? 1 : 0;
    for (std::size_t h = 0; h < kMaxHands; ++h)
      if (hands_[h] && write_next_tick(h)) ++some;
    if (some == 0) break;
    written += some;
  }
  if (overflowed_.load(std::memory_order_relaxed) && failure_.empty())
    fail_with(
        "The recording ended because the disk or this computer was too busy to write it. The part "
        "saved until then is valid. Record to a local disk, and close other programs.");
  return written;
}

bool RecordFeed::has_written(std::span<const std::uint64_t, kMaxHands> ticks) const {
  for (std::size_t h = 0; h < kMaxHands; ++h)
    if (ticks[h] > (hands_[h] ? hands_[h]->written.load(std::memory_order_relaxed) : 0))
      return false;
  return true;
}

bool RecordFeed::write_next_tick(std::size_t h) {
  Hand& hand = *hands_[h];
  if (!hand.next) {
    TickRecord record;
    if (!hand.ticks.pop(record)) return false;
    hand.next = record;
  }
  if (hand.next->bone_step > steps_written_ || !has_written(hand.next->other_ticks)) return false;
  const Result<void> added = writer_.add(*hand.next, h);
  if (!added) {
    fail_with("The recording ended: " + added.error().message());
    return false;
  }
  hand.written.store(hand.next->tick, std::memory_order_relaxed);
  hand.next.reset();
  write_events(hand);
  return true;
}

void RecordFeed::write_events(Hand& hand) {
  Event event;
  while (hand.events.pop(event))
    if (const auto added = writer_.add(event); !added)
      return fail_with("The recording ended: " + added.error().message());
}

bool RecordFeed::write_next_step() {
  if (!next_step_) {
    StepRecord record;
    if (!steps_.pop(record)) return false;
    next_step_ = record;
  }
  if (!has_written(next_step_->tool_ticks)) return false;
  const Result<void> added = writer_.add(*next_step_);
  if (!added) {
    fail_with("The recording ended: " + added.error().message());
    return false;
  }
  steps_written_ = next_step_->step;
  next_step_.reset();
  return true;
}

void RecordFeed::add(const StoredState& state) {
  if (!failure_.empty()) return;
  if (const auto added = writer_.add(state); !added)
    fail_with("The recording ended: " + added.error().message());
}

void RecordFeed::fail_with(std::string message) {
  failure_ = std::move(message);
  ended_.store(true, std::memory_order_relaxed);
  failed_.store(true, std::memory_order_release);
}

std::string RecordFeed::early_end() const {
  return failed_.load(std::memory_order_acquire) ? failure_ : std::string();
}

Result<void> RecordFeed::finish() {
  drain();
  const Result<void> closed = writer_.finish();
  if (!failure_.empty()) return fail(failure_);
  return closed;
}

}  // namespace osteon
