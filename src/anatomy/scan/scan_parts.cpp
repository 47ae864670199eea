#include "scan/scan_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bone/nearby_surface.h"

namespace osteon {

const ScanLayer* ScanProfile::at(double distance_m) const {
  const ScanLayer* found = nullptr;
  for (const ScanLayer& layer : layers_)
    if (distance_m < -layer.depth_m) found = &layer;
  return found;
}

ScanShare ScanProfile::mean(double distance_m, double width_m) const {
  const double lo = distance_m - 0.5 * width_m, hi = distance_m + 0.5 * width_m;
  ScanShare share;
  for (std::size_t n = 0; n < layers_.size(); ++n) {
    const double from = n + 1 < layers_.size() ? -layers_[n + 1].depth_m : lo;
    const double to = -layers_[n].depth_m;
    const double part = std::max(0.0, std::min(hi, to) - std::max(lo, from)) / width_m;
    share.part += part;
    share.hu += part * layers_[n].hu;
  }
  return share;
}

bool ScanProfile::flat(double distance_m, double reach_m) const {
  return std::none_of(layers_.begin(), layers_.end(), [&](const ScanLayer& layer) {
    return std::abs(distance_m + layer.depth_m) <= reach_m;
  });
}

NearestSurfaces::NearestSurfaces(const std::vector<ScanSurfaces>& surfaces)
    : surfaces_(surfaces), last_(surfaces.size(), 0) {
  for (const ScanSurfaces& targets : surfaces) triangle_.emplace_back(targets.size(), 0);
}

double NearestSurfaces::at_least_m(std::size_t surfaces, const Vec3& p_P) const {
  double least = std::numeric_limits<double>::infinity();
  for (const ScanTarget& target : surfaces_[surfaces])
    least = std::min(least, distance_to_box(p_P, target.box));
  return least;
}

NearSurface NearestSurfaces::find(std::size_t surfaces, const Vec3& p_P) {
  const ScanSurfaces& targets = surfaces_[surfaces];
  std::vector<std::uint32_t>& triangle = triangle_[surfaces];
  // The target that was nearest to the last point most likely is again, and rules out the others.
  std::size_t of = last_[surfaces];
  ClosestPoint best = targets[of].distance.closest(p_P, triangle[of]);
  triangle[of] = best.triangle;
  for (std::size_t n = 0; n < targets.size(); ++n) {
    if (n == last_[surfaces] || distance_to_box(p_P, targets[n].box) >= best.signed_distance)
      continue;
    const ClosestPoint closest = targets[n].distance.closest(p_P, triangle[n]);
    triangle[n] = closest.triangle;
    if (closest.signed_distance >= best.signed_distance) continue;
    best = closest;
    of = n;
  }
  last_[surfaces] = of;
  if (std::abs(best.signed_distance) > 1e-6)
    return {best.signed_distance, (p_P - best.point) / best.signed_distance};
  const TriMesh& mesh = targets[of].distance.mesh();
  const Triangle& t = mesh.triangles[best.triangle];
  const Vec3 across =
      (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
  return {best.signed_distance, across.normalized()};
}

}  // namespace osteon
