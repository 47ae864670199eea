#pragma once

#include <cstdint>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// A mesh with equal vertices made one and its broken triangles left out, and what the shading
/// needs to know of it.
struct Surface {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  ///< unit, weighted by the triangles' angles at the vertex
  std::vector<Triangle> triangles;
  /// Neighbours of vertex k: neighbours[first[k]] up to neighbours[first[k + 1]].
  std::vector<std::uint32_t> first, neighbours;
};

/// `place`, if given: of each vertex the index of its point; 2^32 - 1 where it has none.
Surface make_surface(const TriMesh& mesh, std::vector<std::uint32_t>* place = nullptr);
/// Its points and triangles alone, without normals and neighbours.
Surface welded(const TriMesh& mesh, std::vector<std::uint32_t>* place = nullptr);

/// Makes the normals anew, of points that have moved.
void make_normals(Surface& surface);

/// True when every edge runs once each way and the volume inside is positive.
bool encloses_volume(const Surface& surface);

/// Replaces every value `passes` times by the mean of itself and its neighbours.
void smooth(const Surface& surface, int passes, std::vector<float>& values);

/// Mean curvature as seen from outside, 1/m: ridges positive, hollows negative. Estimate: mean over
/// the neighbours j of -2 n_i.(p_j - p_i)/|p_j - p_i|^2, the normal curvature towards each
/// (Taubin 1995, eq. 5).
std::vector<float> mean_curvature(const Surface& surface);

}  // namespace osteon
