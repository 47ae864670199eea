#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/render/scope_renderer.h"
#include "osteon/render/water_bit.h"

namespace osteon {

/// How a scope's picture that is kept was drawn: of another that is drawn so, nothing would look
/// different.
struct ScopePainted {
  int side_px = 0;
  Pose X_WC;
  double half_field_rad = 0, barrel = 1;
  std::vector<Pose> parts, tools;
  std::vector<std::size_t> instruments;
  std::vector<float> ghosts;
  std::uint64_t version = 0, wall = 0;
  ScopeWater water;
  Vec3 white = Vec3::Ones();
  std::vector<WaterBit> bits;
  /// Poses may differ by less than a student can see.
  bool still(const ScopePainted& b) const;
};

}  // namespace osteon
