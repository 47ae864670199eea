#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cloud.h"
#include "osteon/hull/hull.h"
#include "polytope.h"

namespace osteon::hull {

/// What the first stage leaves.
struct FirstStage {
  std::optional<Polytope> polytope;   ///< none when the points span no volume
  std::vector<std::uint32_t> points;  ///< that may lie outside of it, rising, and its vertices
  HullFailure failure = HullFailure::kAllInAPlane;  ///< meaningful without polytope only
};

/// First stage, after QuickHull (Barber et al. 1996): divides the points by a plane through extreme
/// ones (x_min, x_max and the one farthest from their line), raises a tetrahedron on it, lets it
/// grow by the points farthest out in some hundred directions, and discards what lies inside.
FirstStage quickhull(const Cloud& cloud);

}  // namespace osteon::hull
