#pragma once

#include <cstdint>
#include <vector>

#include "osteon/mesh/tet_improve.h"
#include "tet/tet_flips.h"
#include "tet/tet_work.h"

namespace osteon {

/// Moves one vertex to where the worst of its elements is best, by pattern search; a boundary
/// vertex along the surface. Returns whether it moved.
class VertexMover {
 public:
  VertexMover(TetWork& work, const SurfaceProjection& project, double slack_m)
      : work_(work), project_(project), slack_m_(slack_m), hints_(work.vertex_count(), 0) {}
  bool move(std::uint32_t v);
  double distance(const Vec3& p);

 private:
  /// A better place near home, by steps along `directions` that are halved when none helps; `land`
  /// takes the aim of a step, its length and the worth to beat, and gives where it leads, if
  /// anywhere.
  template <class Directions, class Land>
  Vec3 climb(std::uint32_t v, double worth, const Directions& directions, const Land& land) const;
  /// Calls f(a, b, c) with the corners of every face at v that lies on the boundary, outward.
  template <class F>
  void each_boundary_face(std::uint32_t v, const F& f) const;
  bool move_inside(std::uint32_t v);
  bool move_along_surface(std::uint32_t v);
  double mean_edge(std::uint32_t v) const;
  /// Normal of the boundary at a vertex; zero where it has no clear side.
  Vec3 boundary_normal(std::uint32_t v) const;
  /// How far the middles of the boundary's faces around v lie from the surface, the worst.
  double sag(std::uint32_t v);

  TetWork& work_;
  const SurfaceProjection& project_;
  double slack_m_;
  std::vector<std::uint32_t> hints_;
  std::uint32_t last_hint_ = 0;
};

}  // namespace osteon
