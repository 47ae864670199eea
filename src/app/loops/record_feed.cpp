#include "loops/record_feed.h"

namespace osteon {
namespace {

std::size_t capacity(double seconds, double rate_hz) {
  return static_cast<std::size_t>(seconds * rate_hz);
}

}  // namespace

RecordFeed::RecordFeed(RecordingWriter writer, double seconds)
    : writer_(std::move(writer)),
      ticks_(capacity(seconds, 1000.0)),
      steps_(capacity(seconds, 1000.0)) {}

std::size_t RecordFeed::drain() {
  std::size_t written = 0;
  while (failure_.empty()) {
    const bool tick = write_next_tick();
    const bool step = write_next_step();
    if (!tick && !step) break;
    written += (tick ? 1u : 0u) + (step ? 1u : 0u);
  }
  if (overflowed_.load(std::memory_order_relaxed) && failure_.empty())
    fail_with(
        "The disk was too slow and the recording ended; what was saved up to then is good. "
        "Record to a local disk.");
  return written;
}

bool RecordFeed::write_next_tick() {
  if (!next_tick_) {
    TickRecord record;
    if (!ticks_.pop(record)) return false;
    next_tick_ = record;
  }
  if (next_tick_->bone_step > steps_written_) return false;
  const Result<void> added = writer_.add(*next_tick_);
  if (!added) {
    fail_with("The recording ended: " + added.error().message());
    return false;
  }
  ticks_written_.store(next_tick_->tick, std::memory_order_relaxed);
  next_tick_.reset();
  return true;
}

bool RecordFeed::write_next_step() {
  if (!next_step_) {
    StepRecord record;
    if (!steps_.pop(record)) return false;
    next_step_ = record;
  }
  if (next_step_->tool_tick > ticks_written_.load(std::memory_order_relaxed)) return false;
  const Result<void> added = writer_.add(*next_step_);
  if (!added) {
    fail_with("The recording ended: " + added.error().message());
    return false;
  }
  steps_written_ = next_step_->step;
  next_step_.reset();
  return true;
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
