#pragma once

#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A closed surface with each vertex moved so that the planes of its triangles move along their
/// normals, outwards by `by_m`, inwards where it is negative (in least squares). Where the surface
/// is bent more tightly than that, what comes out is folded over itself: as a polygon's offset, it
/// holds the points that it winds around more than zero times (Chen and McMains, Polygon Offsetting
/// by Computing Winding Numbers, 2005).
TriMesh offset_surface(const TriMesh& mesh, double by_m);
/// The same, each vertex by its own length.
TriMesh offset_surface(const TriMesh& mesh, const std::vector<double>& by_m);

}  // namespace osteon
