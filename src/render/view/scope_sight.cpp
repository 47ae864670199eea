#include "osteon/render/scope_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "osteon/mesh/distance.h"
#include "surface/ray_bvh.h"

namespace osteon {
namespace {

constexpr double kSight_m = 0.060;

Aabb box_of(const TriMesh& mesh) {
  Aabb box;
  for (const Vec3& v : mesh.vertices) box.include(v);
  return box;
}

double distance_to(const Aabb& box, const Vec3& p) {
  return (box.lo - p).cwiseMax(p - box.hi).cwiseMax(0).norm();
}

}  // namespace

double ScopeSight::share_of(const std::string& part) const {
  for (const SeenPart& seen : parts)
    if (seen.name == part) return seen.share;
  return 0;
}

struct ScopeRays::Impl {
  struct Part {
    std::string name;
    TriMesh mesh_M;
    Pose X_WM;
    bool bone = false, fat = false;
    RayBvh rays;
  };
  std::vector<Part> parts;

  Part& add(const std::string& name, const TriMesh& mesh, const Pose& X_WM) {
    parts.push_back({name, mesh, X_WM, false, false, RayBvh(mesh.vertices, mesh.triangles)});
    return parts.back();
  }

  std::optional<std::pair<std::size_t, double>> first_hit(const Ray& ray_W) const;
  void find_clearance(const Vec3& tip_W, ScopeSight& sight) const;
};

// Fat is not seen from inside: it gives way to the tip.
std::optional<std::pair<std::size_t, double>> ScopeRays::Impl::first_hit(const Ray& ray_W) const {
  std::optional<std::pair<std::size_t, double>> first;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Part& part = parts[k];
    const Pose X_MW = part.X_WM.inverse();
    const Vec3 origin = X_MW * ray_W.origin_W, dir = X_MW.rotate(ray_W.dir_W);
    const auto hit = part.rays.closest(origin, dir, first ? first->second : kSight_m);
    if (!hit) continue;
    const Triangle& t = part.mesh_M.triangles[hit->triangle];
    const auto& v = part.mesh_M.vertices;
    const Vec3 normal = (v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]);
    if (part.fat && normal.dot(dir) > 0) continue;
    first = {k, hit->t};
  }
  return first;
}

void ScopeRays::Impl::find_clearance(const Vec3& tip_W, ScopeSight& sight) const {
  sight.clearance_m = std::numeric_limits<double>::infinity();
  for (const Part& part : parts) {
    const Vec3 tip_M = part.X_WM.inverse() * tip_W;
    if (part.fat) continue;
    // What lies farther off than its box need not be searched.
    const double far = part.bone ? sight.clearance_m : 0;
    if (distance_to(box_of(part.mesh_M), tip_M) > far) continue;
    const double d = MeshDistance(part.mesh_M).closest(tip_M).signed_distance;
    if (part.bone && d < sight.clearance_m) {
      sight.clearance_m = d;
      sight.nearest = part.name;
    } else if (!part.bone && d < 0) {
      sight.within = part.name;
    }
  }
}

ScopeRays::ScopeRays(const Case& the_case) {
  auto impl = std::make_unique<Impl>();
  for (const Bone& bone : the_case.bones) impl->add(bone.name, bone.mesh, bone.X_WB).bone = true;
  for (const SoftPart& soft : the_case.softs) {
    if (soft.kind == "skin") continue;
    impl->add(soft.name, soft.mesh_W, {}).fat = soft.kind == "fat";
  }
  impl_ = std::move(impl);
}

ScopeRays::~ScopeRays() = default;
ScopeRays::ScopeRays(ScopeRays&&) noexcept = default;
ScopeRays& ScopeRays::operator=(ScopeRays&&) noexcept = default;

ScopeSight ScopeRays::look(const ScopeCamera& camera, int across) const {
  ScopeSight sight;
  impl_->find_clearance(camera.X_WC().p, sight);
  const int side = std::max(across, 2);
  const Viewport viewport{0, 0, side, side};
  std::vector<SeenPart> seen(impl_->parts.size());
  int count = 0;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto ray = camera.ray_through(viewport, x + 0.5, y + 0.5);
      if (!ray) continue;
      ++count;
      const auto hit = impl_->first_hit(*ray);
      if (!hit) continue;
      SeenPart& part = seen[hit->first];
      part.nearest_m = part.share > 0 ? std::min(part.nearest_m, hit->second) : hit->second;
      part.share += 1;
    }
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (seen[k].share == 0) continue;
    seen[k].name = impl_->parts[k].name;
    seen[k].share /= count;
    sight.parts.push_back(std::move(seen[k]));
  }
  std::stable_sort(sight.parts.begin(), sight.parts.end(),
                   [](const SeenPart& a, const SeenPart& b) { return a.share > b.share; });
  return sight;
}

}  // namespace osteon
