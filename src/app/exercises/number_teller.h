#pragma once

#include <deque>
#include <optional>
#include <span>

#include "osteon/scene/command.h"

namespace osteon {

/// Tells the physics a row of numbers by commands that are recorded: an order, then each number.
/// What does not come is told again, but not before it had time to: the last command counts, since
/// where pictures are slow it leaves long after the first.
class NumberTeller {
 public:
  NumberTeller(CommandKind order, CommandKind number) : order_(order), number_(number) {}

  /// At each look at the scene, before `take`.
  void look(double now_s) {
    if (telling()) last_s_ = now_s;
  }
  /// Some of it is still to be taken.
  bool telling() const { return !waiting_.empty(); }
  /// What was told last may not have come yet.
  bool under_way(double now_s) const { return last_s_ && now_s - *last_s_ < kAgain_s; }
  void tell(std::span<const double> numbers, double now_s) {
    last_s_ = now_s;
    waiting_.push_back({order_, 0});
    for (const double number : numbers) waiting_.push_back({number_, number});
  }
  /// The next command; none: there is nothing to say.
  std::optional<Command> take() {
    if (waiting_.empty()) return std::nullopt;
    const Command next = waiting_.front();
    waiting_.pop_front();
    return next;
  }

 private:
  static constexpr double kAgain_s = 1;
  CommandKind order_, number_;
  std::deque<Command> waiting_;
  std::optional<double> last_s_;
};

}  // namespace osteon
