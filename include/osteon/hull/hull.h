#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// Closed convex polyhedron. Vertices are corners only (no point of the input inside a facet or an
/// edge is kept). Coplanar triangles share one plane.
struct Hull {
  std::vector<Vec3> vertices;           ///< metres, in the frame of the input
  std::vector<std::uint32_t> source;    ///< index in the input of each vertex
  std::vector<Triangle> triangles;      ///< counter-clockwise seen from outside
  std::vector<Plane> planes;            ///< one a facet: unit outward normal, n.x <= d inside
  std::vector<std::uint32_t> plane_of;  ///< index in `planes` of each triangle
  Vec3 centroid = Vec3::Zero();         ///< centre of volume
  double volume = 0;                    ///< m^3
};

enum class HullFailure { kTooFewPoints, kNotFinite, kAllAtOnePoint, kAllOnALine, kAllInAPlane };
std::string_view describe(HullFailure failure);

/// How the two stages shared the work.
struct HullStats {
  std::size_t input_points = 0;
  std::size_t duplicates = 0;              ///< exact copies met; those inside count as discarded
  std::size_t discarded_by_quickhull = 0;  ///< found inside the growing polyhedron
  std::size_t given_to_wrapping = 0;       ///< taken into the polyhedron
  std::size_t discarded_by_wrapping = 0;   ///< not a corner of the result
  std::size_t exact_tests = 0;             ///< orientation tests that the filter could not decide
  double seconds = 0;
};

struct HullOutcome {
  std::optional<Hull> hull;
  HullFailure failure = HullFailure::kTooFewPoints;  ///< meaningful without `hull` only
};

/// Convex hull by the hybrid of the wrist simulator's paper (section 5.1): QuickHull on the two
/// sides of a plane through extreme points discards what lies inside the growing polyhedron, what
/// is left is added to it, then gift wrapping closes the facets. Time n log n, for the order in
/// which points are added (docs/architecture.md). Orientation tests are exact (filtered), so
/// the vertex set is that of exact arithmetic, for any finite coordinates. Planes, volume and
/// centroid are rounded: their squares and cubes must fit doubles. A plane's normal is good to
/// rounding and its d is the largest n.x of its facet, so vertices stay inside within 1e-12 of the
/// largest coordinate. Deterministic. Duplicates are fine; flat, collinear
/// or non-finite input ends in a named failure.
HullOutcome build_hull(std::span<const Vec3> points, HullStats* stats = nullptr);

/// The hull's surface as a mesh, in the same frame.
TriMesh to_mesh(const Hull& hull);

}  // namespace osteon
