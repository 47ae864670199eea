#pragma once

#include <array>
#include <cstdint>
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

/// A screw was turned in beside the graft and let go: {how deep mm; degrees between it and the
/// tunnel; tension N}.
inline constexpr EventKind kScrewIn{462};
/// The same, of the knee: {degrees of flexion; cycles of bending under tension; width of the screw
/// less that of the tunnel, mm}.
inline constexpr EventKind kGraftFixed{463};
/// The knee with the graft in it was stretched out and bent again: {how often; tension N; 0}.
inline constexpr EventKind kKneeCycled{464};

/// Length of the way between both mouths by flexion, while the knee is bent with the graft in it.
struct BentGraft {
  static constexpr std::size_t kPlaces = 14;  ///< every 10 degrees from 0
  std::array<double, kPlaces> lengths_m{};    ///< 0: it was never bent to there
};
/// Longest less shortest; 0: the knee was not bent.
double excursion_m(const BentGraft& bent);

/// Follows a graft that is placed by what snapshots say. A function of them: a replay finds the
/// same. The hand of an event is the first.
class PlacingWatch {
 public:
  void add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out);
  /// None: there were no tunnels for a graft yet.
  std::optional<PlacingPlan> plan() const;
  const BentGraft& bent() const { return bent_; }
  const GraftPlacingState& state() const { return seen_; }

 private:
  void add_fixing(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out);

  BentGraft bent_;
  std::uint32_t cycles_ = 0;
  GraftPlacingState seen_;
};

}  // namespace osteon
