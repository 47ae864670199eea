#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

struct ClosestPoint {
  Vec3 point = Vec3::Zero();   ///< on the surface, m
  std::uint32_t triangle = 0;  ///< the lowest of those that hold the point
  /// Distance, negative inside; of a mesh without triangles infinite.
  double signed_distance = std::numeric_limits<double>::infinity();
};

/// Closest points of a mesh, by a tree of boxes that is built once. The sign is that of the angle
/// weighted pseudo-normal (Baerentzen and Aanaes 2005): right everywhere for a closed mesh that
/// faces outwards. Holds a copy of the mesh; queries may run on several threads.
class MeshDistance {
 public:
  explicit MeshDistance(TriMesh mesh);

  ClosestPoint closest(const Vec3& p) const;
  /// The same, found sooner when `guess` is the triangle of a point nearby.
  ClosestPoint closest(const Vec3& p, std::uint32_t guess) const;
  /// Distance to one triangle: never less than that to the mesh.
  double distance_to(const Vec3& p, std::uint32_t triangle) const;
  const TriMesh& mesh() const { return mesh_; }

 private:
  struct Builder;
  struct Search;

  /// Four boxes side by side, so that one pass of the vector units looks at all of them.
  struct Node {
    std::array<Eigen::Array4d, 3> lo, hi;  ///< by axis, then by child
    std::array<std::uint32_t, 4> child;    ///< triangles where `leaf`, else nodes
    std::uint32_t count = 0;               ///< of children
    bool leaf = false;
  };

  ClosestPoint finish(Search& search) const;
  void compute_normals();

  TriMesh mesh_;
  double scale_ = 0;         ///< largest coordinate, m
  std::vector<Node> nodes_;  ///< the first is the root
  std::vector<Vec3> face_normals_;
  std::vector<Vec3> sure_normals_;  ///< the same, zero where rounding may have turned them
  std::vector<std::array<Vec3, 3>> edge_normals_;  ///< of each triangle: from corner k to the next
  std::vector<Vec3> vertex_normals_;
};

}  // namespace osteon
