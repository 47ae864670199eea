#include "bone/surface_samples.h"

#include <cmath>

namespace osteon {
namespace {

double area_of(const TriMesh& mesh, const Triangle& t) {
  const Vec3 a = mesh.vertices[t[1]] - mesh.vertices[t[0]];
  const Vec3 b = mesh.vertices[t[2]] - mesh.vertices[t[0]];
  return 0.5 * a.cross(b).norm();
}

double fraction(double x) { return x - std::floor(x); }

Vec3 place_in(const TriMesh& mesh, const Triangle& t, std::size_t n) {
  constexpr double kPlastic = 1.32471795724474602596;  // root of x^3 = x + 1
  double u = fraction(0.5 + static_cast<double>(n) / kPlastic);
  double v = fraction(0.5 + static_cast<double>(n) / (kPlastic * kPlastic));
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const Vec3& a = mesh.vertices[t[0]];
  return a + u * (mesh.vertices[t[1]] - a) + v * (mesh.vertices[t[2]] - a);
}

}  // namespace

std::vector<Vec3> surface_samples(const TriMesh& mesh, std::size_t count) {
  double whole = 0;
  for (const Triangle& t : mesh.triangles) whole += area_of(mesh, t);
  std::vector<Vec3> points;
  points.reserve(count);
  double passed = 0;
  for (const Triangle& t : mesh.triangles) {
    passed += area_of(mesh, t);
    while (points.size() < count &&
           (static_cast<double>(points.size()) + 0.5) / static_cast<double>(count) * whole <=
               passed)
      points.push_back(place_in(mesh, t, points.size()));
  }
  return points;
}

}  // namespace osteon
