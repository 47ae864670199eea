#include "osteon/mesh/thickness.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr int kShrinks = 40;

double ball_diameter(const MeshDistance& surface, const Vec3& p, const Vec3& nhat,
                     double largest_m) {
  double r = 0.5 * largest_m;
  for (int step = 0; step < kShrinks; ++step) {
    const Vec3 center = p - r * nhat;
    const Vec3 q = surface.closest(center).point;
    if ((q - center).norm() >= r * (1 - 1e-6)) break;
    const Vec3 across = p - q;
    const double along = nhat.dot(across);
    if (!(along > 0)) break;
    const double next = across.squaredNorm() / (2 * along);
    if (!(next < r)) break;
    // cos(60 degrees), seen from the centre of the ball that touches both.
    if (nhat.dot(q - (p - next * nhat)) > 0.5 * next) break;
    r = next;
  }
  return 2 * r;
}

}  // namespace

std::vector<ThicknessSample> thickness_samples(const MeshDistance& surface, std::size_t samples,
                                               double largest_m) {
  const TriMesh& mesh = surface.mesh();
  std::vector<ThicknessSample> out;
  if (mesh.triangles.empty() || samples == 0) return out;
  const std::size_t stride = std::max<std::size_t>(1, mesh.triangles.size() / samples);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += stride) {
    const Triangle& corner = mesh.triangles[t];
    const Vec3 &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]],
               &c = mesh.vertices[corner[2]];
    const Vec3 n = (b - a).cross(c - a);
    const double length = n.norm();
    if (!(length > 0)) continue;
    const Vec3 middle = (a + b + c) / 3;
    out.push_back({middle, ball_diameter(surface, middle, n / length, largest_m), 0.5 * length});
  }
  return out;
}

double thickness_quantile(std::vector<ThicknessSample> samples, double share) {
  if (samples.empty()) return 0;
  std::stable_sort(samples.begin(), samples.end(),
                   [](const ThicknessSample& a, const ThicknessSample& b) {
                     return a.thickness_m < b.thickness_m;
                   });
  double whole = 0;
  for (const ThicknessSample& s : samples) whole += s.area_m2;
  double passed = 0;
  for (const ThicknessSample& s : samples) {
    passed += s.area_m2;
    if (passed >= share * whole) return s.thickness_m;
  }
  return samples.back().thickness_m;
}

}  // namespace osteon
