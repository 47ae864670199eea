#pragma once

#include <cstddef>
#include <string>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// What `repair` did and what it had to leave.
struct RepairReport {
  std::size_t welded_vertices = 0;
  std::size_t unused_vertices = 0;
  std::size_t degenerate_triangles = 0;
  std::size_t duplicate_triangles = 0;
  std::size_t fin_triangles = 0;  ///< small open patches that stood on a whole surface
  std::size_t flipped_triangles = 0;
  std::size_t filled_holes = 0;
  std::size_t capped_ends = 0;         ///< of those filled: open ends, as of a cut shaft
  std::size_t open_holes = 0;          ///< too large or too tangled to fill
  std::size_t non_manifold_edges = 0;  ///< left as they were
  std::size_t misoriented_edges = 0;   ///< left on a surface of one side, such as a Moebius strip
  /// "welded 2834 vertices, filled 1 hole", or "nothing to mend".
  std::string summary() const;
};

struct RepairOptions {
  double weld_distance_m = 1e-7;
  std::size_t largest_hole_edges = 200;  ///< a flat rim may have 5000
};

/// Welds vertices, drops degenerate and duplicate triangles and fins, orients all triangles
/// outwards, fills holes up to the given size. The result may still be open: see the report.
///
/// Outwards is away from the solid: a closed part inside another one is its cavity and faces into
/// it. A flat triangle on an edge goes by flipping its longest edge, so that no gap opens. A hole
/// gets the triangulation of least area (Barequet and Sharir 1995) over its rim, a larger one a
/// flat lid where its rim is flat; a sheet, whose rim would need as much area again, stays open.
/// Triangles keep their order, vertices come in the order in which triangles name them. Indices
/// must fit, coordinates must be finite.
RepairReport repair(TriMesh& mesh, const RepairOptions& options = {});

/// Joins vertices within `distance_m` (0: of equal coordinates) of an earlier one, which stays, and
/// drops vertices that no triangle names. Returns how many were joined.
std::size_t weld_vertices(TriMesh& mesh, double distance_m);

}  // namespace osteon
