#pragma once

#include <functional>

#include "osteon/base/result.h"
#include "osteon/mesh/local_field.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Negative inside, positive outside, about metres of distance near the surface.
using ScalarField = std::function<double(const Vec3&)>;

struct IsosurfaceOptions {
  double cell_m = 0.0006;
  /// The field promises |field(p)| <= stretch * distance(p, surface) + slack_m; blocks of the grid
  /// that this places clear of the surface are skipped.
  double stretch = 1;
  double slack_m = 0;
  int relax_steps = 3;  ///< rounds of tangential smoothing, each followed by projection
  /// Vertices stay off the surface by up to half a cell where on it triangles would pass through
  /// each other, at creases and where it turns sharply. Costs a search for crossings.
  bool uncrossed = false;
};

/// Zero surface of `field` inside `box`: closed, manifold, counter-clockwise seen from outside.
/// Dual marching cubes (Nielson 2004) whose ambiguous faces are resolved so that no edge has more
/// than two triangles (after Wenger, "Isosurfaces", 2013, ch. 5); vertices are then moved onto the
/// surface. Fails when the cell or box is unusable, the field is not finite, nothing is inside, or
/// the inside reaches the rim of the box. The same input gives the same bytes.
Result<TriMesh> isosurface(const ScalarField& field, const Aabb& box,
                           const IsosurfaceOptions& options = {});

/// The same surface, bit by bit, of a field that knows itself; `stretch` and `slack_m` are not
/// asked for.
Result<TriMesh> isosurface(const LocalField& field, const Aabb& box,
                           const IsosurfaceOptions& options = {});

}  // namespace osteon
