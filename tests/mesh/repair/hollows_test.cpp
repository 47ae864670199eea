#include "osteon/mesh/hollows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/shapes.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"

namespace osteon {
namespace {

constexpr double kOuter = 0.006;  // radius of a shell, m
constexpr double kInner = 0.0042;

TriMesh grown(const ScalarField& field) {
  IsosurfaceOptions options;
  options.cell_m = 0.0005;
  const Vec3 half = Vec3::Constant(1.2 * kOuter);
  return std::move(isosurface(field, {-half, half}, options).value());
}

double shell(const Vec3& p) { return std::max(p.norm() - kOuter, kInner - p.norm()); }

// A shell with a round hole at +z.
TriMesh drilled(double hole_radius) {
  return grown([=](const Vec3& p) {
    const double beside = std::sqrt(p.x() * p.x() + p.y() * p.y());
    const double hole = p.z() > 0 ? beside - hole_radius : p.norm();
    return std::max(shell(p), -hole);
  });
}

// The old vertices farther out than the shell's middle, but for a round lid at +z, lie on `now`.
void expect_same_outside(const TriMesh& now, const TriMesh& then, double lid_radius) {
  const MeshDistance after(now);
  for (const Vec3& v : then.vertices) {
    const bool under_lid = v.z() > 0 && std::hypot(v.x(), v.y()) < lid_radius;
    if (v.norm() < 0.5 * (kOuter + kInner) || under_lid) continue;
    ASSERT_LT(std::abs(after.closest(v).signed_distance), 3e-5) << v.transpose();
  }
}

TEST(FillHollows, OfNothingNothing) {
  TriMesh none;
  EXPECT_EQ(fill_hollows(none), 0u);
  TriMesh open = test::cube(0.01);
  open.triangles.pop_back();
  const TriMesh before = open;
  EXPECT_EQ(fill_hollows(open), 0u);
  EXPECT_EQ(open.triangles, before.triangles);
}

TEST(FillHollows, ASolidStaysBitByBit) {
  for (const TriMesh& solid : {test::cube(0.006), test::sphere(0.006, 12)}) {
    TriMesh mesh = solid;
    EXPECT_EQ(fill_hollows(mesh), 0u);
    EXPECT_EQ(mesh.vertices, solid.vertices);
    EXPECT_EQ(mesh.triangles, solid.triangles);
  }
}

TEST(FillHollows, AClosedCavityGoes) {
  TriMesh mesh = grown(shell);
  const TriMesh before = mesh;
  const double solid = 4 * M_PI / 3 * kOuter * kOuter * kOuter;
  ASSERT_LT(volume(mesh), 0.7 * solid);
  EXPECT_EQ(fill_hollows(mesh), 1u);
  EXPECT_TRUE(topology(mesh).closed());
  EXPECT_EQ(topology(mesh).components, 1u);
  EXPECT_NEAR(volume(mesh), solid, 0.01 * solid);
  expect_same_outside(mesh, before, 0);
}

TEST(FillHollows, AboutAClosedCavityTheOutsideStaysBitByBit) {
  TriMesh mesh = test::cube(0.01);
  TriMesh hole = test::cube(0.0025, Vec3(-0.0025, -0.0025, -0.0025));
  for (Triangle& t : hole.triangles) std::swap(t[1], t[2]);
  mesh = test::joined(mesh, hole);
  EXPECT_EQ(fill_hollows(mesh), 1u);
  const TriMesh outside = test::cube(0.01);
  EXPECT_EQ(mesh.vertices.size(), outside.vertices.size());
  ASSERT_EQ(mesh.triangles.size(), outside.triangles.size());
  for (std::size_t t = 0; t < outside.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(mesh.vertices[mesh.triangles[t][k]], outside.vertices[outside.triangles[t][k]]);
}

TEST(FillHollows, AHoleThatNoBallPassesGetsALid) {
  constexpr double kHole = 0.0012, kBall = 0.0016;
  const TriMesh before = drilled(kHole);
  TriMesh mesh = before;
  EXPECT_EQ(fill_hollows(mesh, kBall), 1u);
  EXPECT_TRUE(topology(mesh).closed());
  EXPECT_EQ(topology(mesh).components, 1u);
  const double solid = 4 * M_PI / 3 * kOuter * kOuter * kOuter;
  EXPECT_NEAR(volume(mesh), solid, 0.03 * solid);
  expect_same_outside(mesh, before, 1.5 * kHole);
  // Nothing of the inside is left: the middle is deep in bone. The lid lies where a ball rests on
  // the rim, or a cell deeper.
  const MeshDistance after(mesh);
  EXPECT_LT(after.closest(Vec3::Zero()).signed_distance, -0.004);
  const double rim = std::sqrt(kOuter * kOuter - kHole * kHole);
  const double sunk = kBall - std::sqrt(kBall * kBall - kHole * kHole);
  const Vec3 lid(0, 0, rim - sunk);
  EXPECT_LT(std::abs(after.closest(lid).signed_distance), 0.5 * kBall);
}

TEST(FillHollows, ABallThatPassesFindsNoHollow) {
  const TriMesh before = drilled(0.0025);
  TriMesh mesh = before;
  EXPECT_EQ(fill_hollows(mesh, 0.0016), 0u);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

// A bowl is no hollow, nor is a cleft in which no ball fits.
TEST(FillHollows, WhatABallReachesStays) {
  const TriMesh before = grown([](const Vec3& p) {
    const double bowl = (p - Vec3(0, 0, kOuter)).norm() - 0.004;
    const double cleft = std::max(std::abs(p.x()) - 0.0008, p.z() + 0.002);
    return std::max({p.norm() - kOuter, -bowl, -cleft});
  });
  TriMesh mesh = before;
  EXPECT_EQ(fill_hollows(mesh, 0.0016), 0u);
  EXPECT_EQ(mesh.vertices, before.vertices);
}

TEST(FillHollows, TheReferencePisiformIsAShellWithHoles) {
  const auto file = test::shared_folder() / "anatomy/wrist/pisiform.stl";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  TriMesh mesh = load_mesh(file, 1.0).value();
  repair(mesh);
  const double before = volume(mesh);
  EXPECT_GE(fill_hollows(mesh), 1u);
  EXPECT_TRUE(topology(mesh).closed());
  EXPECT_EQ(topology(mesh).components, 1u);
  EXPECT_GT(volume(mesh), 1.2 * before);
}

}  // namespace
}  // namespace osteon
