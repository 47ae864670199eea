#include "osteon/anatomy/bone_gaps.h"

#include <algorithm>

#include "nearby_surface.h"
#include "osteon/base/types.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

struct Body {
  MeshDistance surface;
  Aabb box;
};

/// Least signed distance of the vertices of `from` to `to`; `limit` where none is nearer.
double least(const Body& from, const Body& to, double limit) {
  const Aabb near = to.box.grown(std::max(limit, 0.0));
  NearbySurface surface(to.surface, to.box);
  for (const Vec3& p : from.surface.mesh().vertices) {
    if (!near.overlaps({p, p})) continue;
    if (const auto at = surface.nearer_than(limit, p)) limit = std::min(limit, at->signed_distance);
  }
  return limit;
}

}  // namespace

std::vector<BoneGap> bone_gaps(std::span<const TriMesh> meshes_W, double reach_m) {
  std::vector<Body> bodies;
  for (const TriMesh& mesh : meshes_W) bodies.push_back({MeshDistance(mesh), bounds(mesh)});
  std::vector<BoneGap> gaps;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j) {
      if (!bodies[i].box.grown(reach_m).overlaps(bodies[j].box)) continue;
      const double there = least(bodies[i], bodies[j], reach_m);
      const double back = least(bodies[j], bodies[i], reach_m);
      const double gap = std::min(there, back);
      if (gap < reach_m) gaps.push_back({i, j, gap});
    }
  return gaps;
}

}  // namespace osteon
