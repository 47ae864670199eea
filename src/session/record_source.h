#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "osteon/record/recording.h"

namespace osteon {

/// Where a replay takes a recording's pieces from: memory or a file. Each function gives some
/// records from a number on, none at the end.
struct RecordSource {
  const RecordingHeader* header = nullptr;
  bool complete = false;
  std::function<Result<std::vector<TickRecord>>(std::size_t hand, std::uint64_t first)> ticks;
  std::function<Result<std::vector<StepRecord>>(std::uint64_t first)> steps;
  std::function<Result<std::vector<StoredState>>()> states;
  std::function<Result<std::string>(std::uint64_t step)> state;
};

/// Both must outlive the source.
RecordSource source_of(const Recording& recording);
RecordSource source_of(RecordingReader& reader);

/// The records of one kind in order, some at a time.
template <class Record>
class RecordStream {
 public:
  using More = std::function<Result<std::vector<Record>>(std::uint64_t first)>;
  RecordStream(More more, std::uint64_t first) : more_(std::move(more)), next_(first) {}

  /// Null: at the end, or at the error.
  const Record* peek() {
    if (at_ < some_.size()) return &some_[at_];
    if (ended_) return nullptr;
    auto more = more_(next_);
    if (!more) error_ = more.error();
    some_ = more ? std::move(*more) : std::vector<Record>();
    at_ = 0;
    ended_ = some_.empty();
    return ended_ ? nullptr : some_.data();
  }
  void pop() {
    ++at_;
    ++next_;
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  More more_;
  std::vector<Record> some_;
  std::size_t at_ = 0;
  std::uint64_t next_;
  bool ended_ = false;
  std::optional<Error> error_;
};

}  // namespace osteon
