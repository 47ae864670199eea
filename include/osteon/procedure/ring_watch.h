#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/event.h"
#include "osteon/scene/rings.h"
#include "osteon/scene/state.h"

namespace osteon {

/// A loose ring, a bone, has been {0: taken from where it lay, 1: left on a peg, 2: left elsewhere;
/// 0; 0}; the place is where its middle lay, or lies. The session makes none of them.
inline constexpr EventKind kRingMoved{409};

/// Follows the loose rings of a case, 100 times a second: a ring lies once it has not moved for
/// 0.1 s on what is under it. A function of what the snapshots say and of the tools: a replay finds
/// the same. The hand of an event is the one whose tip is nearest.
class RingWatch {
 public:
  static constexpr double kStill_s = 0.1;
  static constexpr double kTaken_m = 0.001;  ///< from where it lay

  RingWatch(const Case& the_case, double tick_s);
  void add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
           std::vector<Event>& out);

 private:
  struct Followed {
    bool lies = true;
    Vec3 lay_W = Vec3::Zero();  // where it lay last
    Vec3 at_W = Vec3::Zero();
    std::uint64_t moved_tick = 0;
  };
  void follow(std::size_t ring, std::span<const ToolState* const> tools, std::vector<Event>& out);

  RingSet set_;
  std::vector<Followed> rings_;
  std::vector<Vec3> centers_W_;
  std::uint64_t stride_, still_ticks_;
};

}  // namespace osteon
