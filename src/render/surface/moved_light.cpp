#include "surface/moved_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "surface/rooted.h"
#include "surface/surface.h"

namespace osteon {
namespace {

std::array<float, 3> as_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

constexpr double kLightReach_m = 0.008;  // as far apart as vertices of skin are, and more
constexpr double kDarkest_m = 0.006;     // so deep in a cut it is as dark as it gets

// The mean of the light near a place, the nearer the more.
class LightNear {
 public:
  LightNear(const TriMesh& rest, const Aabb& box) {
    for (std::uint32_t v = 0; v < rest.vertices.size(); ++v)
      if (((rest.vertices[v] - box.lo).array() > -kLightReach_m).all() &&
          ((box.hi - rest.vertices[v]).array() > -kLightReach_m).all())
        near_.push_back(v);
  }
  ShadedMesh::Shade at(const TriMesh& rest, const std::vector<std::uint32_t>& place,
                       const std::vector<ShadedMesh::Shade>& baked, const Vec3& p) const {
    std::array<double, 3> sum{};
    double weights = 0;
    for (const std::uint32_t v : near_) {
      const double share =
          1 - (rest.vertices[v] - p).squaredNorm() / (kLightReach_m * kLightReach_m);
      if (!(share > 0) || place[v] >= baked.size()) continue;
      const ShadedMesh::Shade& shade = baked[place[v]];
      const double weight = share * share;
      sum[0] += weight * shade.openness;
      sum[1] += weight * shade.cavity;
      sum[2] += weight * shade.mottle;
      weights += weight;
    }
    ShadedMesh::Shade out{255, 128, 128, 128};
    if (!(weights > 0)) return out;
    out.openness = static_cast<std::uint8_t>(std::lround(sum[0] / weights));
    out.cavity = static_cast<std::uint8_t>(std::lround(sum[1] / weights));
    out.mottle = static_cast<std::uint8_t>(std::lround(sum[2] / weights));
    return out;
  }

 private:
  std::vector<std::uint32_t> near_;
};

// The roots of the points that stand where those of the rest did.
std::vector<ShadedMesh::Root> moved_roots(const std::vector<ShadedMesh::Root>& roots,
                                          const std::vector<std::uint32_t>& rest_place,
                                          const std::vector<std::uint32_t>& moved_place,
                                          std::size_t rest_points) {
  constexpr std::uint32_t kNowhere = 0xffffffffu;
  std::vector<std::uint32_t> to(rest_points, kNowhere);
  for (std::size_t v = 0; v < moved_place.size() && v < rest_place.size(); ++v)
    if (rest_place[v] < to.size()) to[rest_place[v]] = moved_place[v];
  std::vector<ShadedMesh::Root> out;
  for (ShadedMesh::Root root : roots) {
    root.vertex = root.vertex < to.size() ? to[root.vertex] : kNowhere;
    if (root.vertex != kNowhere) out.push_back(root);
  }
  return out;
}

}  // namespace

// Both surfaces are welded as prepare_case welds them. Points that lie on one another in one of the
// two alone give and take the light of any of them.
ShadedMesh moved_light(const TriMesh& rest, const RestLight& light, const TriMesh& moved) {
  const std::vector<ShadedMesh::Shade>& baked = light.shades;
  ShadedMesh out;
  std::vector<std::uint32_t> rest_place, moved_place;
  if (rest.vertices.size() != moved.vertices.size()) return out;
  if (make_surface(rest, &rest_place).points.size() != baked.size()) return out;
  Surface s = make_surface(moved, &moved_place);
  draw_in(moved_roots(light.roots, rest_place, moved_place, baked.size()), s);
  out.closed = encloses_volume(s);
  out.triangles = s.triangles;
  out.shades.assign(s.points.size(), {255, 128, 128, 128});
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    out.positions.push_back(as_floats(s.points[k]));
    out.normals.push_back(as_floats(s.normals[k]));
  }
  for (std::size_t v = 0; v < moved_place.size(); ++v)
    if (moved_place[v] < s.points.size() && rest_place[v] < baked.size())
      out.shades[moved_place[v]] = baked[rest_place[v]];
  return out;
}

std::uint8_t wound_depth(double depth_m) {
  return static_cast<std::uint8_t>(
      129 + std::lround(126 * std::clamp(depth_m / kDeepestWound_m, 0.0, 1.0)));
}

ShadedMesh opened_light(const TriMesh& rest, const RestLight& light, const TriMesh& opened,
                        std::span<const float> depth_m) {
  const std::vector<ShadedMesh::Shade>& baked = light.shades;
  ShadedMesh out;
  std::vector<std::uint32_t> rest_place, place;
  if (opened.vertices.size() != depth_m.size() || opened.vertices.size() < rest.vertices.size())
    return out;
  if (make_surface(rest, &rest_place).points.size() != baked.size()) return out;
  Surface s = make_surface(opened, &place);
  draw_in(moved_roots(light.roots, rest_place, place, baked.size()), s);
  out.closed = false;
  out.triangles = s.triangles;
  out.shades.assign(s.points.size(), {255, 128, 128, 128});
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    out.positions.push_back(as_floats(s.points[k]));
    out.normals.push_back(as_floats(s.normals[k]));
  }
  Aabb box;
  for (std::size_t v = rest.vertices.size(); v < opened.vertices.size(); ++v)
    box.include(opened.vertices[v]);
  const LightNear near(rest, box);
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] >= s.points.size()) continue;
    ShadedMesh::Shade& shade = out.shades[place[v]];
    if (v < rest.vertices.size()) {
      if (rest_place[v] < baked.size()) shade = baked[rest_place[v]];
      continue;
    }
    shade = near.at(rest, rest_place, baked, opened.vertices[v]);
    const double depth = static_cast<double>(depth_m[v]);
    if (!(depth > 0)) continue;
    shade.openness = static_cast<std::uint8_t>(
        std::lround(255 * std::clamp(0.92 - 0.36 * depth / kDarkest_m, 0.5, 0.92)));
    shade.cavity = 128;
    shade.felt = wound_depth(depth);
  }
  return out;
}

}  // namespace osteon
