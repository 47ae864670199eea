#pragma once

#include <span>
#include <string>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/event.h"

namespace osteon {

/// Something for a timeline, at its moment.
struct RunEvent {
  double time_s = 0;
  Event event;
};

/// What happened in a run, in the order told, but contacts: those are spans of their own.
class RunEvents {
 public:
  static constexpr std::size_t kMostKept = 4000;
  void add(const Event& event, double tick_s);
  void clear() { events_.clear(); }
  std::span<const RunEvent> events() const { return events_; }

 private:
  bool repeats(const Event& event, double time_s) const;
  std::vector<RunEvent> events_;
};

/// "left: takes Hook probe". `instruments`: titles by their place in the tray.
std::string describe_event(const Event& event, const Case& the_case,
                           std::span<const std::string> instruments,
                           std::span<const std::string> portals,
                           std::span<const std::string> hands);

}  // namespace osteon
