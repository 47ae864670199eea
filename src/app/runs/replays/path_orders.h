#pragma once

#include <optional>

#include "runs/replays/path_commands.h"

namespace osteon {

/// What a path says of instruments, power and jaws, for a hand that follows it over and over in
/// real time.
class PathOrders {
 public:
  /// As PathCommands; `path` must not be empty.
  PathOrders(const ProbePath& path, std::span<const std::string> tray, double tick_s);
  /// In the tray.
  std::uint32_t first_instrument() const { return first_; }
  /// What the hand is to be told at one of its ticks, one order a call; none: nothing.
  std::optional<Command> at(std::uint64_t tick);

 private:
  PathCommands commands_;
  std::uint32_t first_;
  double start_s_, length_s_, tick_s_;
};

/// `path` without what it says of instruments: power and jaws alone.
ProbePath without_instruments(ProbePath path);

}  // namespace osteon
