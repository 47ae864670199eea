#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "osteon/base/types.h"

namespace osteon {

/// What cuts have left of one cell of a solid: parts that do not hang together inside of it.
struct CutCell {
  static constexpr std::size_t kParts = 4;
  std::uint32_t count = 0;
  std::array<double, kParts> left{};  ///< of the cell's whole filling
  std::array<Vec3, kParts> middle{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  /// Of the sides x+, y+, z+: bit 4 a + b says that part a goes on in part b of the cell beyond.
  std::array<std::uint16_t, 3> beyond{};
  bool operator==(const CutCell&) const = default;
};

}  // namespace osteon
