#include "soft/soft_patch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/surface_checks.h"

namespace osteon {
namespace {

/// Square of n x n cells of 1 mm in the plane z = 0, its `inside` given by a function.
template <class Inside>
CoveredPatch square(int n, const Inside& inside) {
  CoveredPatch patch;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const Vec3 p(0.001 * x, 0.001 * y, 0);
      patch.vertices.push_back({p, Vec3::UnitZ(), inside(p), 0.002});
    }
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (n + 1) + x);
      const auto b = a + static_cast<std::uint32_t>(n + 1);
      patch.triangles.push_back({a, a + 1, b + 1});
      patch.triangles.push_back({a, b + 1, b});
    }
  return patch;
}

TEST(SoftPatch, NothingInsideGivesNothing) {
  const CoveredPatch cut = cut_patch(square(3, [](const Vec3&) { return -1.0; }), 0);
  EXPECT_TRUE(cut.triangles.empty());
  EXPECT_TRUE(raise_patch(cut).triangles.empty());
}

TEST(SoftPatch, ADiscIsCutAtItsRimAndRaisedToItsVolume) {
  const Vec3 center(0.010, 0.010, 0);
  constexpr double kRadius = 0.0073;
  const CoveredPatch cut =
      cut_patch(square(20, [&](const Vec3& p) { return kRadius - (p - center).norm(); }), 0);
  for (const Triangle& t : cut.triangles)
    for (const std::uint32_t v : t)
      EXPECT_LT((cut.vertices[v].p - center).norm(), kRadius + 0.00005);
  const TriMesh shell = raise_patch(cut);
  EXPECT_TRUE(checks::is_closed_manifold(shell));
  EXPECT_TRUE(checks::has_single_fans(shell));
  EXPECT_NEAR(checks::signed_volume(shell) / (3.14159265358979 * kRadius * kRadius * 0.002), 1,
              0.03);
}

TEST(SoftPatch, SmallIslandsGo) {
  const auto two = [](const Vec3& p) {
    return std::max(0.004 - (p - Vec3(0.005, 0.005, 0)).norm(),
                    0.0012 - (p - Vec3(0.016, 0.016, 0)).norm());
  };
  const TriMesh shell = raise_patch(cut_patch(square(20, two), 10e-6));
  EXPECT_EQ(checks::euler_number(shell), 2) << "one piece";
}

/// Two triangles that touch at a corner alone make two bodies.
TEST(SoftPatch, WhatTouchesAtAPointIsParted) {
  CoveredPatch patch;
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.001, 0, 0), Vec3(0.001, 0.001, 0), Vec3(-0.001, 0, 0),
                        Vec3(-0.001, -0.001, 0)})
    patch.vertices.push_back({p, Vec3::UnitZ(), 1, 0.0005});
  patch.triangles = {{0, 1, 2}, {0, 3, 4}};
  const TriMesh shell = raise_patch(patch);
  EXPECT_TRUE(checks::is_closed_manifold(shell));
  EXPECT_TRUE(checks::has_single_fans(shell));
  EXPECT_EQ(checks::euler_number(shell), 4);
  EXPECT_NE(shell.vertices[0], shell.vertices[1]) << "apart by place too";
}

}  // namespace
}  // namespace osteon
