#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/base/types.h"

namespace osteon {

/// Share of a load or a way at a time, and its first two derivatives.
struct Ramp {
  double share = 0, per_s = 0, per_s2 = 0;
};

/// From 0 at time 0 to 1 at `over_s`, with a velocity and an acceleration that begin and end at
/// zero: 10 s^3 - 15 s^4 + 6 s^5. With `over_s` of 0: 1 from the start.
Ramp smooth_ramp(double time_s, double over_s);

/// One axis of one node that a support holds or moves: its way from the rest place is `to_m` times
/// the ramp.
struct HeldAxis {
  std::uint32_t slot = 0;
  std::uint32_t axis = 0;
  double to_m = 0;
  double over_s = 0;
  std::uint32_t entry = 0;  ///< which support its reaction counts for
};

/// A force on one node, times the ramp.
struct NodeLoad {
  std::uint32_t slot = 0;
  Vec3 force_n = Vec3::Zero();
  double over_s = 0;
};

/// What acts on a solid from outside. An axis of a node is in `held` once at most.
struct Supports {
  std::vector<HeldAxis> held;
  std::vector<NodeLoad> loads;
  Vec3 gravity_m_per_s2 = Vec3::Zero();
  std::size_t entries = 0;
};

}  // namespace osteon
