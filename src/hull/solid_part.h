#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "excess.h"
#include "height_grid.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon::hull {

/// A part of the solid: what lies in some convex cells.
struct SolidShape {
  TriMesh surface;             ///< of the whole mesh, clipped
  TriMesh coarse;              ///< of the mesh in which cuts are looked for, clipped
  std::vector<TriMesh> cells;  ///< convex, closed
};

struct SolidPart {
  std::uint32_t id = 0;  ///< never used twice
  SolidShape shape;
  Hull hull;
  Excess excess;               ///< of `hull`
  Aabb box;                    ///< of `hull`
  std::vector<Vec3> extremes;  ///< corners of `hull` that lie outermost in some directions
  bool stuck = false;          ///< no cut was found
};

/// Corners of the hull that lie farthest along the 26 directions of a cube's faces, edges and
/// corners.
std::vector<Vec3> extremes_of(const Hull& hull);

/// One vertex a cell of a grid: the first of the mesh in it. Triangles within a cell vanish.
TriMesh coarsened(const TriMesh& mesh, double cell_m);

void append(TriMesh& to, const TriMesh& from);

TriMesh box_mesh(const Aabb& box);

/// What of the cells lies below the plane, and above it. A sliver without volume vanishes.
std::vector<TriMesh> cells_below(const std::vector<TriMesh>& cells, const Plane& plane);
std::vector<TriMesh> cells_above(const std::vector<TriMesh>& cells, const Plane& plane);

/// Planes that may part what is bent: through the deepest place under the hull and along its
/// normal, turned about it, and along the edges of the facet there. None where the depth has no
/// slope.
std::vector<Plane> notch_cuts(const SolidPart& part, HeightGrid& grid);

/// Planes across, for a part whose notch cannot be told (in the middle of a hole).
std::vector<Plane> halving_cuts(const SolidPart& part);

}  // namespace osteon::hull
