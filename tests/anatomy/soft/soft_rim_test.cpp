#include "soft/soft_rim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anatomy/soft/soft_checks.h"

namespace osteon {
namespace {

constexpr int kCells = 24;
constexpr double kRadius = 0.0083;
const Vec3 kCenter(0.012, 0.012, 0);

/// A plate of 24 x 24 mm in cells of 1 mm, of which a disc is covered up to a wavering rim.
CoveredPatch plate(double waver) {
  CoveredPatch whole;
  for (int y = 0; y <= kCells; ++y)
    for (int x = 0; x <= kCells; ++x) {
      const Vec3 p(0.001 * x, 0.001 * y, 0);
      const double noise = waver * ((3 * x + 5 * y) % 4 - 1.5);
      whole.vertices.push_back({p, Vec3::UnitZ(), kRadius - (p - kCenter).norm() + noise, 0.001});
    }
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x) {
      const auto a = static_cast<std::uint32_t>(y * (kCells + 1) + x);
      const auto b = a + kCells + 1;
      whole.triangles.push_back({a, a + 1, b + 1});
      whole.triangles.push_back({a, b + 1, b});
    }
  return whole;
}

MeshDistance surface_of(const CoveredPatch& whole) {
  TriMesh mesh;
  for (const CoveredVertex& v : whole.vertices) mesh.vertices.push_back(v.p);
  mesh.triangles = whole.triangles;
  return MeshDistance(std::move(mesh));
}

bool nowhere(const Vec3&) { return false; }

TEST(SoftRim, AWaveringRimBecomesACircle) {
  const CoveredPatch whole = plate(0.0002);
  CoveredPatch patch = cut_patch(whole, 0);
  const double before = checks::rim_waver_deg_per_mm(raise_patch(patch));
  even_rim(surface_of(whole), whole, nowhere, patch);
  const TriMesh shell = raise_patch(patch);
  EXPECT_GT(before, 12);
  EXPECT_LT(checks::rim_waver_deg_per_mm(shell), 0.1 * before);
  EXPECT_TRUE(checks::is_closed_manifold(shell));
  EXPECT_EQ(checks::folds(shell), 0u);
  EXPECT_NEAR(checks::signed_volume(shell) / (3.14159265358979 * kRadius * kRadius * 0.001), 1,
              0.03);
}

TEST(SoftRim, VerticesStayOnTheSurfaceAndReadWhatIsThere) {
  const CoveredPatch whole = plate(0);
  CoveredPatch patch = cut_patch(whole, 0);
  even_rim(surface_of(whole), whole, nowhere, patch);
  for (const Triangle& t : patch.triangles)
    for (const std::uint32_t i : t) {
      const CoveredVertex& v = patch.vertices[i];
      EXPECT_NEAR(v.p.z(), 0, 1e-12);
      EXPECT_NEAR(v.inside, kRadius - (v.p - kCenter).norm(), 2e-4) << "cells are straight";
    }
}

TEST(SoftRim, WhatIsToStayStays) {
  const CoveredPatch whole = plate(0.0002);
  CoveredPatch patch = cut_patch(whole, 0);
  const CoveredPatch before = patch;
  even_rim(
      surface_of(whole), whole, [](const Vec3& p) { return p.x() > kCenter.x(); }, patch);
  std::size_t moved = 0, stayed = 0;
  for (std::size_t i = whole.vertices.size(); i < patch.vertices.size(); ++i) {
    const bool same = (patch.vertices[i].p - before.vertices[i].p).norm() < 1e-12;
    if (before.vertices[i].p.x() > kCenter.x()) {
      EXPECT_TRUE(same);
      ++stayed;
    } else if (!same) {
      ++moved;
    }
  }
  EXPECT_GT(stayed, 10u);
  EXPECT_GT(moved, 10u);
}

TEST(SoftRim, NothingCoveredIsLeftAsItIs) {
  CoveredPatch whole = plate(0);
  for (CoveredVertex& v : whole.vertices) v.inside = -1;
  CoveredPatch patch = cut_patch(whole, 0);
  even_rim(surface_of(whole), whole, nowhere, patch);
  EXPECT_TRUE(patch.triangles.empty());
}

}  // namespace
}  // namespace osteon
