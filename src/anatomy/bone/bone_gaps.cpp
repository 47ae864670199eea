#include "osteon/anatomy/bone_gaps.h"

#include <algorithm>

#include "bone/grow.h"
#include "bone/nearby_surface.h"
#include "bone/surface_gaps.h"
#include "osteon/base/types.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

struct Body {
  const MeshDistance* surface = nullptr;
  Aabb box;
};

/// Least signed distance of the vertices of `from` to `to`; `limit` where none is nearer.
double least(const Body& from, const Body& to, double limit) {
  const Aabb near = to.box.grown(std::max(limit, 0.0));
  NearbySurface surface(*to.surface, to.box);
  for (const Vec3& p : from.surface->mesh().vertices) {
    if (!near.overlaps({p, p})) continue;
    if (const auto at = surface.nearer_than(limit, p)) limit = std::min(limit, at->signed_distance);
  }
  return limit;
}

}  // namespace

std::vector<BoneGap> surface_gaps(const std::vector<const MeshDistance*>& surfaces, double reach_m,
                                  const GenerateOptions& options) {
  std::vector<Body> bodies;
  for (const MeshDistance* surface : surfaces) bodies.push_back({surface, bounds(surface->mesh())});
  std::vector<BoneGap> gaps;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      if (bodies[i].box.grown(reach_m).overlaps(bodies[j].box)) gaps.push_back({i, j, reach_m});
  run_tasks(options, gaps.size(), [&](std::size_t k) {
    const Body &first = bodies[gaps[k].first], &second = bodies[gaps[k].second];
    gaps[k].gap_m = std::min(least(first, second, reach_m), least(second, first, reach_m));
  });
  std::erase_if(gaps, [&](const BoneGap& gap) { return !(gap.gap_m < reach_m); });
  return gaps;
}

std::vector<BoneGap> bone_gaps(std::span<const TriMesh> meshes_W, double reach_m) {
  const std::vector<MeshDistance> surfaces(meshes_W.begin(), meshes_W.end());
  std::vector<const MeshDistance*> asked;
  for (const MeshDistance& surface : surfaces) asked.push_back(&surface);
  return surface_gaps(asked, reach_m, {});
}

}  // namespace osteon
