#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "osteon/hull/hull.h"

namespace osteon {

/// Bounds of each run of planes, so that a search may skip runs. For u measured from the body's
/// centre, every plane of a run keeps n.u - offset <= mid.u + top + sum_j half_j |u_j - at_j|.
struct PlaneBlocks {
  std::vector<double> mid_x, mid_y, mid_z;     ///< middle of the run's normals
  std::vector<double> half_x, half_y, half_z;  ///< half extents of the run's normals
  std::vector<double> at_x, at_y, at_z;        ///< a point on the run's facets, from the centre
  std::vector<double> top;
};

/// Boxes of each run of vertices: middle and half extents, in the hull's frame.
struct VertexBlocks {
  std::vector<double> mid_x, mid_y, mid_z;
  std::vector<double> half_x, half_y, half_z;
};

/// A hull made ready for contact queries: planes and vertices as separate coordinate arrays in the
/// hull's own frame, ordered so that neighbours stand together, and padded to a multiple of
/// kBlock with copies of the last. Immutable after make_convex_body.
struct ConvexBody {
  static constexpr std::uint32_t kBlock = 16;                   ///< planes or vertices of a run
  static constexpr std::uint32_t kGroupRuns = 8;                ///< runs of a group
  static constexpr std::uint32_t kGroup = kGroupRuns * kBlock;  ///< planes or vertices of a group

  std::vector<double> nx, ny, nz, d;  ///< planes, n.x <= d inside, |n| = 1
  std::vector<double> offset;         ///< planes from the centre: n.(x - center) <= offset inside
  std::vector<double> vx, vy, vz;     ///< vertices
  std::uint32_t plane_count = 0;
  std::uint32_t vertex_count = 0;
  std::vector<std::uint32_t> plane_source;   ///< index in the hull of each plane
  std::vector<std::uint32_t> vertex_source;  ///< index in the hull of each vertex
  PlaneBlocks plane_blocks;                  ///< of each run
  PlaneBlocks plane_groups;                  ///< of each group of runs
  VertexBlocks vertex_blocks;                ///< of each run
  VertexBlocks vertex_groups;                ///< of each group of runs
  std::uint64_t stamp = 0;                   ///< of its planes and vertices; never 0 once made
  Vec3 center = Vec3::Zero();                ///< of the bounding sphere; lies inside the body
  double radius = 0;                         ///< of the bounding sphere
  Aabb box;
  /// Four planes whose normals hold the origin in their convex hull: a first feasible basis of the
  /// depth programme's dual. They touch the largest ball inside the body.
  std::array<std::uint32_t, 4> basis{};
  /// Three planes through the vertex of largest x + y + z whose normals' cone holds (1, 1, 1): a
  /// first feasible basis of the collision test's dual.
  std::array<std::uint32_t, 3> corner{};

  Vec3 normal(std::uint32_t plane) const { return {nx[plane], ny[plane], nz[plane]}; }
  Vec3 vertex(std::uint32_t v) const { return {vx[v], vy[v], vz[v]}; }
};

/// `hull` has at least four planes and bounds a volume (build_hull sees to it).
ConvexBody make_convex_body(const Hull& hull);

/// Largest n.x over the body's vertices; `vertex` gets the index (in the body) of one that has it.
double support(const ConvexBody& body, const Vec3& n, std::uint32_t* vertex = nullptr);

}  // namespace osteon
