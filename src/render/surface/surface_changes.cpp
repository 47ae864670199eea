#include "surface/surface_changes.h"

#include <algorithm>

namespace osteon {
namespace {

constexpr std::size_t kMostChanges = 256;  // older ones may have been anywhere

using Place = std::array<float, 3>;

void include_place(Aabb& box, const Place& p) {
  box.include(Eigen::Vector3f(p[0], p[1], p[2]).cast<double>());
}

void include_corners(Aabb& box, const ShadedMesh& mesh, const Triangle& t) {
  for (const std::uint32_t v : t)
    if (v < mesh.positions.size()) include_place(box, mesh.positions[v]);
}

bool same_shade(const ShadedMesh::Shade& a, const ShadedMesh::Shade& b) {
  return a.openness == b.openness && a.cavity == b.cavity && a.mottle == b.mottle &&
         a.felt == b.felt;
}

}  // namespace

void SurfaceChanges::anywhere() {
  anywhere_ = ++version_;
  last_.clear();
}

void SurfaceChanges::within(std::size_t model, const Aabb& box_M) {
  ++version_;
  if (box_M.empty()) return;
  last_.push_back({version_, model, box_M});
  if (last_.size() <= kMostChanges) return;
  anywhere_ = last_.front().version;
  last_.pop_front();
}

std::vector<SurfaceChanges::One> SurfaceChanges::since(std::uint64_t version) const {
  const auto first = std::find_if(last_.begin(), last_.end(),
                                  [&](const One& one) { return one.version > version; });
  return {first, last_.end()};
}

// A vertex that moves takes its triangles along, and they reach to their other corners.
Aabb changed_box(const ShadedMesh& before, const ShadedMesh& now) {
  Aabb box;
  const std::size_t points = std::min(before.positions.size(), now.positions.size());
  std::vector<std::uint8_t> other(std::max(before.positions.size(), now.positions.size()), 1);
  for (std::size_t v = 0; v < points; ++v)
    other[v] = before.positions[v] != now.positions[v] || before.normals[v] != now.normals[v] ||
               !same_shade(before.shades[v], now.shades[v]);
  const auto touched = [&](const Triangle& t) { return other[t[0]] || other[t[1]] || other[t[2]]; };
  const std::size_t pairs = std::min(before.triangles.size(), now.triangles.size());
  for (std::size_t i = 0; i < std::max(before.triangles.size(), now.triangles.size()); ++i) {
    const bool same = i < pairs && before.triangles[i] == now.triangles[i];
    if (i < before.triangles.size() && (!same || touched(before.triangles[i])))
      include_corners(box, before, before.triangles[i]);
    if (i < now.triangles.size() && (!same || touched(now.triangles[i])))
      include_corners(box, now, now.triangles[i]);
  }
  return box;
}

}  // namespace osteon
