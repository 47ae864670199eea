#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "anatomy/morphometry.h"

// Figures that would be taken from films and sections of a knee, in mm and degrees, on the grown
// surfaces alone. World: x distal, y medial, z anterior.
namespace osteon::checks {

inline constexpr double kDegreesOf = 180 / 3.14159265358979323846;

inline std::vector<Vec3> between_x(const std::vector<Vec3>& points, double lo, double hi) {
  std::vector<Vec3> kept;
  for (const Vec3& p : points)
    if (p.x() >= lo && p.x() <= hi) kept.push_back(p);
  return kept;
}

inline Vec3 landmark_of(const GeneratedAnatomy& anatomy, const std::string& name) {
  for (const GeneratedLandmark& l : anatomy.landmarks)
    if (l.name == name) return l.p_W;
  throw std::out_of_range(name);
}

/// Middle of the box around a slice of 6 mm.
inline Vec3 slice_center(const std::vector<Vec3>& points, double x) {
  Aabb box;
  for (const Vec3& p : between_x(points, x - 0.003, x + 0.003)) box.include(p);
  return box.center();
}

struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};

/// Sphere of least squares: |p|^2 = 2 c.p + (r^2 - |c|^2).
inline Sphere fit_sphere(const std::vector<Vec3>& points) {
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd A(rows, 4);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec3& p = points[static_cast<std::size_t>(i)];
    A.row(i) << 2 * p.x(), 2 * p.y(), 2 * p.z(), 1;
    b(i) = p.squaredNorm();
  }
  const Eigen::Vector4d x = A.colPivHouseholderQr().solve(b);
  const Vec3 c = x.head<3>();
  return {c, std::sqrt(x(3) + c.squaredNorm())};
}

/// Radius of the circle of least squares through points of the plane y = 0.
inline double fit_circle_radius(const std::vector<Vec3>& points) {
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd A(rows, 3);
  Eigen::VectorXd b(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec3& p = points[static_cast<std::size_t>(i)];
    A.row(i) << 2 * p.x(), 2 * p.z(), 1;
    b(i) = p.x() * p.x() + p.z() * p.z();
  }
  const Eigen::Vector3d x = A.colPivHouseholderQr().solve(b);
  return std::sqrt(x(2) + x(0) * x(0) + x(1) * x(1));
}

/// Unit vector from the shaft to the middle of the head: along the neck's own middle 28 mm from the
/// head's, found anew a few times.
inline Vec3 neck_axis(const std::vector<Vec3>& femur, const Vec3& head) {
  Vec3 axis = Vec3(-1, 1, 0).normalized();
  for (int round = 0; round < 8; ++round) {
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (const Vec3& p : femur) {
      const double along = axis.dot(head - p);
      const Vec3 off = (head - p) - along * axis;
      if (std::abs(along - 0.028) > 0.003 || off.norm() > 0.024) continue;
      sum += p;
      count += 1;
    }
    axis = (head - sum / count).normalized();
  }
  return axis;
}

struct FemurFigures {
  double length_mm, bicondylar_mm, condyle_depth_mm, head_mm, neck_shaft_deg, torsion_deg, bow_mm;
};

inline FemurFigures femur_figures(const GeneratedAnatomy& knee) {
  const auto femur = vertices_in_world(bone_named(knee, "femur"));
  const auto end = between_x(femur, -0.045, 1);
  std::vector<Vec3> cap;
  for (const Vec3& p : femur)
    if (p.x() < -0.395 && p.y() > -0.005) cap.push_back(p);
  const Sphere head = fit_sphere(cap);
  const Vec3 neck = neck_axis(femur, head.center);
  const Vec3 distal = (slice_center(femur, -0.20) - slice_center(femur, -0.30)).normalized();
  std::vector<Vec3> centers;
  for (double x = -0.3; x < -0.105; x += 0.02) centers.push_back(slice_center(femur, x));
  const auto side = [](double sign) {
    return [sign](const Vec3& p) { return sign * p.y() > 0.01; };
  };
  const Vec3 behind =
      farthest(end, -Vec3::UnitZ(), side(1)) - farthest(end, -Vec3::UnitZ(), side(-1));
  return {extent_along(femur, Vec3::UnitX()) * 1e3,
          extent_along(end, Vec3::UnitY()) * 1e3,
          extent_along(end, Vec3::UnitZ()) * 1e3,
          2 * head.radius * 1e3,
          std::acos(neck.dot(distal)) * kDegreesOf,
          (std::atan2(neck.z(), neck.y()) - std::atan2(behind.z(), behind.y())) * kDegreesOf,
          fit_circle_radius(centers) * 1e3};
}

/// Walks from `from` along unit `direction` until `inside`; metres, `limit` where it never is.
template <class Inside>
double walk(const Vec3& from, const Vec3& direction, double limit, const Inside& inside) {
  for (double t = 0; t < limit; t += 0.0001)
    if (inside(from + t * direction)) return t;
  return limit;
}

struct NotchFigures {
  double width_mm, depth_mm;
};

/// Depth from Blumensaat's line to the tangent of the condyles at right angles to it; width half
/// way, across the middle of the line.
template <class Inside>
NotchFigures notch_figures(const GeneratedAnatomy& knee, const Inside& inside) {
  const Vec3 back = landmark_of(knee, "blumensaat_posterior");
  const Vec3 front = landmark_of(knee, "blumensaat_anterior");
  const Vec3 along = (front - back).normalized();
  const Vec3 into = along.cross(Vec3::UnitY()) * (along.cross(Vec3::UnitY()).x() > 0 ? 1 : -1);
  const Vec3 middle = 0.5 * (front + back);
  double tangent = 0;
  for (const Vec3& p : vertices_in_world(bone_named(knee, "femur")))
    if (std::abs(along.dot(p - middle)) < 0.003) tangent = std::max(tangent, into.dot(p - middle));
  const Vec3 low = middle + tangent * into;
  const double depth = walk(low, -into, 0.05, inside);
  const Vec3 half = low - 0.5 * depth * into;
  const double width =
      walk(half, Vec3::UnitY(), 0.03, inside) + walk(half, -Vec3::UnitY(), 0.03, inside);
  return {width * 1e3, depth * 1e3};
}

struct TibiaFigures {
  double width_mm, depth_mm;
};

inline TibiaFigures tibia_figures(const GeneratedAnatomy& knee) {
  const auto head = between_x(vertices_in_world(bone_named(knee, "tibia")), -1, 0.024);
  return {extent_along(head, Vec3::UnitY()) * 1e3, extent_along(head, Vec3::UnitZ()) * 1e3};
}

/// Fall of the medial plateau towards the back against the axis of the shaft, between points 13 mm
/// in front of its middle and behind it. `inside` is the tibia.
template <class Inside>
double plateau_slope_deg(const GeneratedAnatomy& knee, const Inside& inside) {
  const auto tibia = vertices_in_world(bone_named(knee, "tibia"));
  const auto top = [&](double z) {
    const Vec3 above(-0.005, 0.02, z);
    return Vec3(above + walk(above, Vec3::UnitX(), 0.03, inside) * Vec3::UnitX());
  };
  const Vec3 forwards = top(0.008) - top(-0.018);
  const Vec3 shaft = (slice_center(tibia, 0.3) - slice_center(tibia, 0.1)).normalized();
  const Vec3 front = (Vec3::UnitZ() - shaft.z() * shaft).normalized();
  return std::atan2(-shaft.dot(forwards), front.dot(forwards)) * kDegreesOf;
}

}  // namespace osteon::checks
