#pragma once

#include <cstddef>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

Aabb bounds(const TriMesh& mesh);
/// Enclosed volume, m^3 (divergence theorem); positive when the triangles face outwards.
double volume(const TriMesh& mesh);
double area(const TriMesh& mesh);
/// Centre of volume; of the bounding box where the surface encloses next to nothing.
Vec3 centroid(const TriMesh& mesh);
/// Unit normals of the vertices, each the mean of its triangles' normals weighted by their area;
/// +z at a vertex of no triangle.
std::vector<Vec3> vertex_normals(const TriMesh& mesh);

/// How the triangles are connected by their vertex indices: weld first, see repair.h.
struct Topology {
  std::size_t boundary_edges = 0;      ///< edges with one triangle
  std::size_t non_manifold_edges = 0;  ///< edges with three triangles or more
  std::size_t misoriented_edges = 0;   ///< edges whose two triangles run the same way
  std::size_t components = 0;          ///< triangles that share an edge belong together
  bool closed() const {
    return boundary_edges == 0 && non_manifold_edges == 0 && misoriented_edges == 0;
  }
};
Topology topology(const TriMesh& mesh);

/// The components by themselves, in the order of their first triangles; without the vertices that
/// no triangle has.
std::vector<TriMesh> connected_parts(const TriMesh& mesh);

}  // namespace osteon
