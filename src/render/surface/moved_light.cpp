#include "surface/moved_light.h"

#include "surface/surface.h"

namespace osteon {
namespace {

std::array<float, 3> as_floats(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

}  // namespace

// Both surfaces are welded as prepare_case welds them. Points that lie on one another in one of the
// two alone give and take the light of any of them.
ShadedMesh moved_light(const TriMesh& rest, const std::vector<ShadedMesh::Shade>& baked,
                       const TriMesh& moved) {
  ShadedMesh out;
  std::vector<std::uint32_t> rest_place, moved_place;
  if (rest.vertices.size() != moved.vertices.size()) return out;
  if (make_surface(rest, &rest_place).points.size() != baked.size()) return out;
  const Surface s = make_surface(moved, &moved_place);
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

}  // namespace osteon
