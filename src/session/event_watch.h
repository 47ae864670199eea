#pragma once

#include "event_list.h"
#include "osteon/session/session_state.h"

namespace osteon {

/// Says when a hand's contacts begin and end and when its force goes over a limit, from its ticks
/// alone. Allocates nothing.
class EventWatch {
 public:
  /// A contact has ended once it has been away so long: a probe that slides over an edge has not
  /// let go.
  static constexpr std::uint64_t kLetGoTicks = 50;
  /// The force is back under its limit below this share of it.
  static constexpr double kBackUnder = 0.9;

  EventWatch(std::uint8_t hand, double tick_s, double limit_n)
      : hand_(hand), tick_s_(tick_s), limit_n_(limit_n) {}
  void see(const ToolState& tool, WatchState& state, EventList& out) const;

 private:
  void see_contacts(const ToolState& tool, WatchState& state, EventList& out) const;
  void see_ends(const ToolState& tool, WatchState& state, EventList& out) const;
  void see_force(const ToolState& tool, WatchState& state, EventList& out) const;
  Event event(const ToolState& tool, EventKind kind, std::uint32_t bone) const;

  std::uint8_t hand_;
  double tick_s_;
  double limit_n_;
};

}  // namespace osteon
