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
  const TriMesh& mesh() const { return mesh_; }

 private:
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< of `order_` in a leaf, else the left child; the right one follows
    std::uint32_t count = 0;  ///< 0: not a leaf
  };
  struct Search;
  ClosestPoint finish(Search& search) const;

  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count,
             const std::vector<Vec3>& centers);
  void compute_normals();

  TriMesh mesh_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  std::vector<Vec3> face_normals_;
  std::vector<std::array<Vec3, 3>> edge_normals_;  ///< of each triangle: from corner k to the next
  std::vector<Vec3> vertex_normals_;
};

}  // namespace osteon
