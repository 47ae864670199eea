#pragma once

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "osteon/anatomy/generate.h"

// Figures that a radiologist or an anatomist would take from the bones, in mm and degrees. They see
// the grown surfaces alone, never the description.
namespace osteon::checks {

struct BoneFigures {
  double volume_mm3 = 0;
  Vec3 centroid_W = Vec3::Zero();
  /// Extents along the principal axes of the volume, longest first.
  Vec3 extents_mm = Vec3::Zero();
};

inline std::vector<Vec3> vertices_in_world(const GeneratedBone& bone) {
  std::vector<Vec3> points;
  for (const Vec3& v : bone.mesh.vertices) points.push_back(bone.X_WB * v);
  return points;
}

inline double extent_along(const std::vector<Vec3>& points, const Vec3& direction) {
  double lo = 1e300, hi = -1e300;
  for (const Vec3& p : points) {
    lo = std::min(lo, direction.dot(p));
    hi = std::max(hi, direction.dot(p));
  }
  return hi - lo;
}

/// Volume, centroid and second moments from tetrahedra over the triangles.
inline BoneFigures figures_of(const GeneratedBone& bone) {
  const std::vector<Vec3> p = vertices_in_world(bone);
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  const Vec3 o = p[0];
  for (const Triangle& t : bone.mesh.triangles) {
    const Vec3 a = p[t[0]] - o, b = p[t[1]] - o, c = p[t[2]] - o, s = a + b + c;
    const double v = a.dot(b.cross(c)) / 6;
    volume += v;
    first += v / 4 * s;
    second +=
        v / 20 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
  }
  const Vec3 mean = first / volume;
  const Mat3 spread = second / volume - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  std::array<double, 3> extents;
  for (int k = 0; k < 3; ++k)
    extents[static_cast<std::size_t>(k)] = extent_along(p, axes.eigenvectors().col(k));
  std::sort(extents.begin(), extents.end(), std::greater<>());
  return {volume * 1e9, mean + o, Vec3(extents[0], extents[1], extents[2]) * 1e3};
}

inline const GeneratedBone& bone_named(const GeneratedAnatomy& anatomy, const std::string& name) {
  for (const GeneratedBone& bone : anatomy.bones)
    if (bone.name == name) return bone;
  throw std::out_of_range(name);
}

/// Middle of the box around the slice x in [from, from + 4 mm].
inline Vec3 slice_middle(const std::vector<Vec3>& points, double from) {
  Aabb box;
  for (const Vec3& p : points)
    if (p.x() >= from && p.x() <= from + 0.004) box.include(p);
  return box.center();
}

inline Vec3 farthest(const std::vector<Vec3>& points, const Vec3& direction,
                     const std::function<bool(const Vec3&)>& accept) {
  Vec3 best = Vec3::Zero();
  double most = -1e300;
  for (const Vec3& p : points)
    if (accept(p) && direction.dot(p) > most) {
      most = direction.dot(p);
      best = p;
    }
  return best;
}

struct DistalRadiusFigures {
  double inclination_deg, volar_tilt_deg, height_mm, ulnar_variance_mm, width_mm, depth_mm;
};

/// As on films: the long axis joins the middles of two slices of the shaft; inclination and height
/// run from the styloid's tip to the middle of the volar and dorsal ulnar corners; tilt joins the
/// dorsal and volar lips of the lunate fossa; variance compares the ulna's dome, styloid left out,
/// with the same ulnar corners.
inline DistalRadiusFigures distal_radius_figures(const GeneratedAnatomy& wrist) {
  const auto radius = vertices_in_world(bone_named(wrist, "radius"));
  const auto ulna = vertices_in_world(bone_named(wrist, "ulna"));
  const Vec3 lunate = figures_of(bone_named(wrist, "lunate")).centroid_W;
  const Vec3 distal = (slice_middle(radius, -0.05) - slice_middle(radius, -0.08)).normalized();
  const Vec3 dorsal = (Vec3::UnitZ() - Vec3::UnitZ().dot(distal) * distal).normalized();
  const Vec3 radial = dorsal.cross(distal);
  const auto any = [](const Vec3&) { return true; };
  const Vec3 tip = farthest(radius, distal, any);
  const Vec3 corner = 0.5 * (farthest(radius, distal - radial + dorsal, any) +
                             farthest(radius, distal - radial - dorsal, any));
  const auto in_fossa = [&](const Vec3& p) { return std::abs(radial.dot(p - lunate)) < 0.003; };
  const Vec3 lips =
      farthest(radius, distal + dorsal, in_fossa) - farthest(radius, distal - dorsal, in_fossa);
  const auto end = [&](const Vec3& p) { return distal.dot(p - corner) > -0.015; };
  std::vector<Vec3> end_points, dome;
  for (const Vec3& p : radius)
    if (end(p)) end_points.push_back(p);
  Aabb head;  // the ulna's last 15 mm; its radial half bears no styloid
  for (const Vec3& p : ulna)
    if (end(p)) head.include(p);
  for (const Vec3& p : ulna)
    if (end(p) && radial.dot(p - head.center()) > 0) dome.push_back(p);
  constexpr double kDegrees = 180 / 3.14159265358979323846;
  return {std::atan2(distal.dot(tip - corner), radial.dot(tip - corner)) * kDegrees,
          std::atan2(distal.dot(lips), dorsal.dot(lips)) * kDegrees,
          distal.dot(tip - corner) * 1e3,
          distal.dot(farthest(dome, distal, any) - corner) * 1e3,
          extent_along(end_points, radial) * 1e3,
          extent_along(end_points, dorsal) * 1e3};
}

}  // namespace osteon::checks
