#pragma once

#include <algorithm>
#include <array>

#include "height_grid.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/joint_ends.h"

namespace osteon::hull {

/// How a hull stands over the surface that it was made from.
struct Excess {
  double need = 0;         ///< most of the height times what its place counts, m
  Vec3 at = Vec3::Zero();  ///< where that is, on the hull
  double height = 0;       ///< there, m
  double moment = 0;       ///< integral over the hull of the square of the need, m^4
};

/// What a place counts when pieces are shared out.
struct PlaceValue {
  JointEnds ends;
  double on_shaft = 1;  ///< elsewhere 1
  double at(const Vec3& p) const { return on_shaft < 1 && ends.on_shaft(p) ? on_shaft : 1; }
  /// Most that a place of the triangle counts.
  double most(const std::array<Vec3, 3>& t) const {
    return std::max({at(t[0]), at(t[1]), at(t[2])});
  }
};

/// Up to which the need of exact_excess may fall short, or a twentieth of it, m.
inline constexpr double kPeakError_m = 2e-5;

/// By samples of the hull's triangles, halved until none is longer than `spacing`, on the grid.
Excess excess(const Hull& hull, HeightGrid& grid, const PlaceValue& value, double spacing);

/// What was sampled so, with the largest need found by distances to the mesh itself where it is
/// above `floor`; or some need above `enough`.
Excess exact_excess(const Hull& hull, HeightGrid& grid, const PlaceValue& value,
                    const Excess& sampled, double floor, double enough);

}  // namespace osteon::hull
