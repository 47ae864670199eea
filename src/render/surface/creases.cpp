#include "surface/creases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace osteon {
namespace {

constexpr double kSharpCosine = 0.5;    // 60 degrees between two triangles at a point
constexpr double kSideCosine = 0.766;   // 40 degrees: they are of one side
constexpr double kBluntCosine = 0.906;  // 25 degrees off the point's normal: surely not sharp
constexpr double kSameCosine = 0.9998;  // one degree: the same point serves both

/// One corner of a triangle.
struct Corner {
  std::uint32_t triangle = 0, place = 0;
};

struct Facet {
  Vec3 nhat = Vec3::Zero();           ///< zero: it has no area
  std::array<double, 3> angle_rad{};  ///< at its corners
};

Facet facet_of(const Surface& s, const Triangle& t) {
  Facet out;
  const Vec3 n = (s.points[t[1]] - s.points[t[0]]).cross(s.points[t[2]] - s.points[t[0]]);
  if (!(n.norm() > 0)) return out;
  out.nhat = n.normalized();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 u = s.points[t[(k + 1) % 3]] - s.points[t[k]];
    const Vec3 v = s.points[t[(k + 2) % 3]] - s.points[t[k]];
    out.angle_rad[k] = std::atan2(u.cross(v).norm(), u.dot(v));
  }
  return out;
}

bool is_sharp(const std::vector<Corner>& corners, const std::vector<Facet>& facets,
              const Vec3& nhat) {
  const auto faces = [&](const Corner& c) -> const Vec3& { return facets[c.triangle].nhat; };
  const bool blunt = std::all_of(corners.begin(), corners.end(), [&](const Corner& c) {
    return faces(c).isZero(0) || faces(c).dot(nhat) > kBluntCosine;
  });
  if (blunt) return false;
  for (const Corner& a : corners)
    for (const Corner& b : corners)
      if (!faces(a).isZero(0) && !faces(b).isZero(0) && faces(a).dot(faces(b)) < kSharpCosine)
        return true;
  return false;
}

Vec3 side_normal(const Corner& of, const std::vector<Corner>& corners,
                 const std::vector<Facet>& facets) {
  const Vec3& own = facets[of.triangle].nhat;
  Vec3 sum = Vec3::Zero();
  for (const Corner& c : corners)
    if (facets[c.triangle].nhat.dot(own) > kSideCosine)
      sum += facets[c.triangle].angle_rad[c.place] * facets[c.triangle].nhat;
  return sum.norm() > 0 ? Vec3(sum.normalized()) : own;
}

std::array<float, 3> floats_of(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

// The first side keeps the point, every other one gets a point in the same place.
void split_point(std::uint32_t point, const std::vector<Corner>& corners,
                 const std::vector<Facet>& facets, ShadedMesh& mesh) {
  std::vector<std::pair<Vec3, std::uint32_t>> sides;
  for (const Corner& corner : corners) {
    if (facets[corner.triangle].nhat.isZero(0)) continue;
    const Vec3 nhat = side_normal(corner, corners, facets);
    const auto known = std::find_if(sides.begin(), sides.end(), [&](const auto& side) {
      return side.first.dot(nhat) > kSameCosine;
    });
    if (known != sides.end()) {
      mesh.triangles[corner.triangle][corner.place] = known->second;
      continue;
    }
    std::uint32_t at = point;
    if (!sides.empty()) {
      at = static_cast<std::uint32_t>(mesh.positions.size());
      const auto position = mesh.positions[point];
      const auto shade = mesh.shades[point];
      mesh.positions.push_back(position);
      mesh.normals.emplace_back();
      mesh.shades.push_back(shade);
    }
    mesh.normals[at] = floats_of(nhat);
    mesh.triangles[corner.triangle][corner.place] = at;
    sides.emplace_back(nhat, at);
  }
}

}  // namespace

void split_creases(const Surface& surface, ShadedMesh& mesh) {
  std::vector<Facet> facets;
  std::vector<std::vector<Corner>> at(surface.points.size());
  for (const Triangle& t : surface.triangles) {
    const auto number = static_cast<std::uint32_t>(facets.size());
    facets.push_back(facet_of(surface, t));
    for (std::uint32_t k = 0; k < 3; ++k) at[t[k]].push_back({number, k});
  }
  for (std::uint32_t point = 0; point < at.size(); ++point)
    if (is_sharp(at[point], facets, surface.normals[point]))
      split_point(point, at[point], facets, mesh);
}

}  // namespace osteon
