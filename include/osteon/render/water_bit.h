#pragma once

#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// Something small in the water before a scope.
struct WaterBit {
  enum class Is : std::uint8_t { kBubble, kFlake };  ///< of air; of loose tissue
  Is is = Is::kBubble;
  Vec3 p_W = Vec3::Zero();
  double radius_m = 0;           ///< of a flake: half of its length
  Quat turn = Quat::Identity();  ///< of a flake: it lies across z, along x
  double shape = 0;              ///< 0 to 1: which of all shapes a flake has
  bool operator==(const WaterBit& b) const {
    return is == b.is && p_W == b.p_W && radius_m == b.radius_m &&
           turn.coeffs() == b.turn.coeffs() && shape == b.shape;
  }
};
inline constexpr std::size_t kMostWaterBits = 128;

}  // namespace osteon
