#include "offset_surface.h"

#include <Eigen/LU>
#include <cmath>

namespace osteon {
namespace {

/// The planes at a vertex: sum over its triangles of area n n^T, and of area n.
struct Planes {
  Mat3 spread = Mat3::Zero();
  Vec3 sum = Vec3::Zero();
};

std::vector<Planes> planes_at_vertices(const TriMesh& mesh) {
  std::vector<Planes> out(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 across = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    const double area = across.norm();
    if (!(area > 0)) continue;
    for (const std::uint32_t v : t) {
      out[v].spread += across * across.transpose() / area;
      out[v].sum += across;
    }
  }
  return out;
}

/// The way d of a vertex that moves its planes by 1 along their normals: least sum of
/// area (n . d - 1)^2, and of a thousandth of the area times d^2, which keeps d short where the
/// planes leave it free. No longer than 2.
Vec3 unit_offset(const Planes& planes) {
  constexpr double kShort = 0.001, kLongest = 2;
  const double area = planes.spread.trace();
  if (!(area > 0)) return Vec3::Zero();
  const Mat3 with_short = planes.spread + kShort * area * Mat3::Identity();
  const Vec3 d = with_short.inverse() * planes.sum;
  const double length = d.norm();
  return length > kLongest ? Vec3(kLongest / length * d) : d;
}

}  // namespace

TriMesh offset_surface(const TriMesh& mesh, const std::vector<double>& by_m) {
  const std::vector<Planes> planes = planes_at_vertices(mesh);
  TriMesh out = mesh;
  for (std::size_t v = 0; v < out.vertices.size(); ++v)
    out.vertices[v] += by_m[v] * unit_offset(planes[v]);
  return out;
}

TriMesh offset_surface(const TriMesh& mesh, double by_m) {
  return offset_surface(mesh, std::vector<double>(mesh.vertices.size(), by_m));
}

}  // namespace osteon
