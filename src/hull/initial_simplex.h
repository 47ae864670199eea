#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "cloud.h"
#include "osteon/hull/hull.h"

namespace osteon::hull {

/// Four points that span a volume; the fourth lies above the triangle of the first three.
struct Simplex {
  std::array<std::uint32_t, 4> corners{};
  std::optional<HullFailure> failure;  ///< exact: the points span no volume
};

/// x_min, x_max, the point x_d farthest from their line, and the point farthest from that plane.
Simplex find_simplex(const Cloud& cloud);

}  // namespace osteon::hull
