#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "osteon/xray/areal_density.h"

// Bodies whose areal density has a closed form.
namespace osteon::testing_xray {

inline TriMesh box(const Vec3& lo, const Vec3& hi) {
  TriMesh mesh;
  for (int n = 0; n < 8; ++n)
    mesh.vertices.emplace_back((n & 1 ? hi : lo).x(), (n & 2 ? hi : lo).y(), (n & 4 ? hi : lo).z());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A box cut along its diagonal: its height falls from hi.z at lo.x to lo.z at hi.x.
inline TriMesh wedge(const Vec3& lo, const Vec3& hi) {
  TriMesh mesh;
  mesh.vertices = {lo,
                   {hi.x(), lo.y(), lo.z()},
                   {lo.x(), lo.y(), hi.z()},
                   {lo.x(), hi.y(), lo.z()},
                   {hi.x(), hi.y(), lo.z()},
                   {lo.x(), hi.y(), hi.z()}};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 3, 1}, {1, 3, 4},
                    {0, 2, 3}, {3, 2, 5}, {1, 4, 2}, {2, 4, 5}};
  return mesh;
}

/// Rings of a globe, its corners on the sphere.
inline TriMesh ball(const Vec3& center, double radius, int rings = 96) {
  TriMesh mesh;
  const int around = 2 * rings;
  const auto at = [&](int ring, int k) {
    return ring == 0       ? 0u
           : ring == rings ? 1u
                           : static_cast<std::uint32_t>(2 + (ring - 1) * around + k % around);
  };
  mesh.vertices = {center + radius * Vec3::UnitZ(), center - radius * Vec3::UnitZ()};
  for (int ring = 1; ring < rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const double a = std::numbers::pi * ring / rings, b = 2 * std::numbers::pi * k / around;
      mesh.vertices.push_back(center + radius * Vec3(std::sin(a) * std::cos(b),
                                                     std::sin(a) * std::sin(b), std::cos(a)));
    }
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < around; ++k) {
      if (ring > 0) mesh.triangles.push_back({at(ring, k), at(ring + 1, k), at(ring, k + 1)});
      if (ring + 1 < rings)
        mesh.triangles.push_back({at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)});
    }
  return mesh;
}

/// A disc with a round hole, between two heights, its corners on both circles.
inline TriMesh washer(double hole_radius, double radius, double z_lo, double z_hi,
                      int around = 256) {
  TriMesh mesh;
  for (int k = 0; k < around; ++k) {
    const double a = 2 * std::numbers::pi * k / around;
    const Vec3 way(std::cos(a), std::sin(a), 0);
    for (const double z : {z_lo, z_hi})
      for (const double r : {hole_radius, radius})
        mesh.vertices.push_back(r * way + z * Vec3::UnitZ());
  }
  // Of each stretch: 0 inner low, 1 outer low, 2 inner high, 3 outer high; then those of the next.
  const auto at = [&](int k, int corner) {
    return static_cast<std::uint32_t>(4 * (k % around) + corner);
  };
  const auto quad = [&](int k, int a, int b) {
    mesh.triangles.push_back({at(k, a), at(k + 1, a), at(k, b)});
    mesh.triangles.push_back({at(k, b), at(k + 1, a), at(k + 1, b)});
  };
  for (int k = 0; k < around; ++k) {
    quad(k, 1, 3);
    quad(k, 3, 2);
    quad(k, 2, 0);
    quad(k, 0, 1);
  }
  return mesh;
}

inline XrayLayer layer(TriMesh mesh, double density,
                       XraySubstance substance = XraySubstance::kBone) {
  return {"phantom",
          {substance, density},
          {{std::make_shared<const TriMesh>(std::move(mesh)), Pose{}}}};
}

/// Source 600 mm over World's origin, detector 400 mm under it, 1000 mm apart; 0.8 mm pixels.
inline XrayView view_from_above(int side = 128, double pixel_m = 0.0008) {
  XrayView view;
  view.source_W = Vec3(0, 0, 0.6);
  view.detector_center_W = Vec3(0, 0, -0.4);
  view.u_W = Vec3::UnitX();
  view.v_W = -Vec3::UnitY();
  view.pixel_m = pixel_m;
  view.width = view.height = side;
  return view;
}

inline Vec3 ray_W(const XrayView& view, int column, int row) {
  return (view.pixel_W(column, row) - view.source_W).normalized();
}

inline double chord_in_box(const Vec3& from, const Vec3& dir, const Vec3& lo, const Vec3& hi) {
  double enter = 0, leave = 1e9;
  for (int a = 0; a < 3; ++a) {
    const double t0 = (lo[a] - from[a]) / dir[a], t1 = (hi[a] - from[a]) / dir[a];
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return std::max(0.0, leave - enter);
}

inline double chord_in_ball(const Vec3& from, const Vec3& dir, const Vec3& center, double radius) {
  const double along = dir.dot(center - from);
  const double aside2 = (center - from).squaredNorm() - along * along;
  return aside2 < radius * radius ? 2 * std::sqrt(radius * radius - aside2) : 0;
}

}  // namespace osteon::testing_xray
