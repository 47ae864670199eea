#pragma once

#include <optional>
#include <vector>

#include "osteon/scene/event.h"
#include "osteon/scene/placing.h"
#include "osteon/scene/state.h"

namespace osteon {

// Codes of events that who watches a graft being placed makes; the session makes none of them.
/// The thread goes through the femur, its end lies in the joint: {how often it was lost; 0; 0}.
inline constexpr EventKind kThreadLaid{457};
/// The thread's end was lost: {how often; 0; 0}.
inline constexpr EventKind kThreadLost{458};
/// The thread's end is out through the tibia: {0; 0; 0}.
inline constexpr EventKind kThreadOut{459};
/// Let go while the button is in its channel: {mm that are missing; largest pull N; 0}.
inline constexpr EventKind kButtonLetGo{460};
/// The button turned: {gap to the cortex mm; largest pull N; mm drawn beyond where it is out}.
inline constexpr EventKind kButtonTurned{461};

/// Follows a graft that is placed by what snapshots say. A function of them: a replay finds the
/// same. The hand of an event is the first.
class PlacingWatch {
 public:
  explicit PlacingWatch(const Case& the_case);
  void add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out);
  /// None: the case has no tunnels for a graft.
  const std::optional<PlacingPlan>& plan() const { return plan_; }
  const GraftPlacingState& state() const { return seen_; }

 private:
  std::optional<PlacingPlan> plan_;
  GraftPlacingState seen_;
};

}  // namespace osteon
