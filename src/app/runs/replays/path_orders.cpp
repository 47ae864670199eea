#include "runs/replays/path_orders.h"

#include <algorithm>
#include <cmath>

#include "loops/path_hand.h"

namespace osteon {

PathOrders::PathOrders(const ProbePath& path, std::span<const std::string> tray, double tick_s)
    : commands_(path, tray),
      first_(commands_.first_instrument()),
      start_s_(path.samples.front().time_s),
      length_s_(std::max(tick_s, closed_path(path).samples.back().time_s - start_s_)),
      tick_s_(tick_s) {}

std::optional<Command> PathOrders::at(std::uint64_t tick) {
  const double time_s = std::fmod(static_cast<double>(tick) * tick_s_, length_s_);
  const Command command = commands_.at(start_s_ + time_s);
  return command.kind == CommandKind::kNone ? std::nullopt : std::optional(command);
}

ProbePath without_instruments(ProbePath path) {
  for (PathSample& sample : path.samples) sample.instrument.clear();
  return path;
}

}  // namespace osteon
