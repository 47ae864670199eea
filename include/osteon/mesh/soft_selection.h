#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// How the weight falls from 1 at the grabbed vertex to 0 at the radius; x is the share of the
/// radius.
enum class FallOff : std::uint8_t {
  kSmooth,  ///< 1 - 3 x^2 + 2 x^3: level at the middle and at the rim
  kCone,    ///< 1 - x
  kDome,    ///< sqrt(1 - x^2): broad, with a rim
  kSpike    ///< (1 - x)^2: narrow, level at the rim
};
/// "smooth", "cone", "dome", "spike".
std::string_view to_text(FallOff fall_off);
std::optional<FallOff> fall_off_from_text(std::string_view text);
/// 0 from x = 1 on.
double fall_off_weight(FallOff fall_off, double x);

struct SoftSelection {
  double radius_m = 0.005;  ///< along the surface
  FallOff fall_off = FallOff::kSmooth;
};

/// A vertex that follows the grabbed one.
struct SoftWeight {
  std::uint32_t vertex = 0;
  double distance_m = 0;  ///< along the surface
  double weight = 0;      ///< in (0, 1]
};

/// Distances along a surface, from one vertex outwards. They are measured over the triangles, not
/// through the air, so that the other side of a thin part stays out of reach: its way leads around
/// the rim.
///
/// A front is carried from vertex to vertex, each reached along an edge or straight across a
/// triangle from where the front seems to come (fast marching with a virtual source: Melvaer and
/// Reimers, Computer Graphics Forum 31, 2012). Exact on a flat fan; elsewhere a little long, by 1 %
/// on even triangles.
class SurfaceWalk {
 public:
  /// Keeps which triangles stand at each vertex; the vertices may move afterwards.
  explicit SurfaceWalk(const TriMesh& mesh);
  /// The vertices nearer than the radius, in the order of their distance, then of their number; the
  /// grabbed one first. `mesh` has the triangles of the one given before.
  std::vector<SoftWeight> select(const TriMesh& mesh, std::uint32_t grabbed,
                                 const SoftSelection& selection) const;
  /// The triangles at a vertex, `triangle[first[v]]` to `triangle[first[v + 1]]`.
  const std::vector<std::uint32_t>& first() const { return first_; }
  const std::vector<std::uint32_t>& triangle() const { return triangle_; }

 private:
  std::vector<std::uint32_t> first_, triangle_;
};

}  // namespace osteon
