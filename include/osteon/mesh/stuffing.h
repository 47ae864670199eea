#pragma once

#include <cstddef>

#include "osteon/base/result.h"
#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/tet_mesh.h"

namespace osteon {

struct StuffingOptions {
  double cell_m = 0.001;  ///< edge of the lattice's cubes
  /// The field promises |field(p)| <= stretch * distance(p, surface) + slack_m; parts of the
  /// lattice that this places clear of the surface are skipped.
  double stretch = 1;
  double slack_m = 0;
  std::size_t most_tets = 4'000'000;  ///< more are refused before they are made
};

/// Fills the inside of `field` (negative there) within `box` with tetrahedra: isosurface stuffing
/// (Labelle and Shewchuk, SIGGRAPH 2007) on a uniform body-centred cubic lattice. Where the surface
/// passes close to a lattice point, the point is warped onto it; the other crossed tetrahedra are
/// cut by stencils. Every element is upright, with dihedral angles between 10.7 and 164.8 degrees;
/// every vertex of its boundary lies on the surface, to 1e-4 of a cell along a lattice edge. What
/// is thinner than about a cell may be lost. The size is uniform: no larger elements inside.
///
/// Fails when the cell or box is unusable, the field is not finite, nothing is inside, the inside
/// reaches the rim of the box, or more than `most_tets` would be made. The same input gives the
/// same bytes.
Result<TetMesh> stuff_isosurface(const ScalarField& field, const Aabb& box,
                                 const StuffingOptions& options = {});

}  // namespace osteon
