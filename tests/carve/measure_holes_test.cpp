#include "osteon/carve/measure_holes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/shapes.h"
#include "osteon/carve/tunnel.h"
#include "osteon/mesh/isosurface.h"

namespace osteon {
namespace {

constexpr double kMm = 1e-3;

TriMesh drilled(const TriMesh& bone, const Vec3& from_mm, const Vec3& to_mm, double diameter_mm) {
  const auto plan = plan_tunnel(bone, {from_mm * kMm, to_mm * kMm, diameter_mm * kMm});
  EXPECT_TRUE(plan);
  const auto cut = advance(*plan, plan->length_m);
  EXPECT_TRUE(cut);
  return drilled_bone(*plan, *cut);
}

TEST(FindHoles, ThereIsNoneInACubeOrABall) {
  EXPECT_TRUE(find_holes({}).empty());
  EXPECT_TRUE(find_holes(test::cube(10 * kMm)).empty());
  EXPECT_TRUE(find_holes(test::sphere(10 * kMm, 30)).empty());
}

TEST(FindHoles, NoneInARodWhoseWallFacesOutwards) {
  TriMesh rod = drilled(test::cube(10 * kMm), {-20, 0, 0}, {20, 0, 0}, 6);
  ASSERT_EQ(find_holes(rod).size(), 1u);
  for (Triangle& t : rod.triangles) test::flip(t);  // the drill's core in place of its hole
  EXPECT_TRUE(find_holes(rod).empty());
}

TEST(FindHoles, ATunnelHasItsAxisDiameterAndLength) {
  const TriMesh mesh = drilled(test::cube(10 * kMm), {-20, 1, 2}, {20, 5, 2}, 6);
  const auto holes = find_holes(mesh);
  ASSERT_EQ(holes.size(), 1u);
  const Hole& h = holes[0];
  EXPECT_NEAR(h.diameter_m, 6 * kMm, 5e-6);
  const Vec3 along = Vec3(40, 4, 0).normalized();
  EXPECT_GT(std::abs(h.axis.dot(along)), 1 - 1e-6);
  EXPECT_NEAR(h.length_m, 20 * kMm / along.x(), 0.05 * kMm);
  EXPECT_TRUE(h.through);
  EXPECT_EQ(h.side_openings, 0u);
  for (const Vec3& end : {h.entry, h.exit}) {
    EXPECT_NEAR(std::abs(end.x()), 10 * kMm, 0.05 * kMm);
    EXPECT_NEAR(end.z(), 2 * kMm, 0.02 * kMm);
  }
  // The wall towards z = 10 mm is 10 - 2 - 3 thick; towards y it comes nearer as the line climbs.
  ASSERT_TRUE(h.thinnest_wall_m);
  EXPECT_LT(*h.thinnest_wall_m, 5 * kMm);
  EXPECT_GT(*h.thinnest_wall_m, 3 * kMm);
}

TEST(FindHoles, ABlindHoleIsEnteredAtItsMouth) {
  const TriMesh mesh = drilled(test::cube(10 * kMm), {-20, 1, 2}, {3, 1, 2}, 6);
  const auto holes = find_holes(mesh);
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_FALSE(holes[0].through);
  EXPECT_NEAR(holes[0].entry.x(), -10 * kMm, 1e-6);
  EXPECT_NEAR(holes[0].exit.x(), 3 * kMm, 1e-5);
  EXPECT_NEAR(holes[0].length_m, 13 * kMm, 1e-5);
  EXPECT_GT(holes[0].axis.x(), 0.9999);
}

TEST(FindHoles, TheThinnestWallIsTheOneTowardsTheNearFace) {
  const TriMesh mesh = drilled(test::cube(10 * kMm), {-20, 5.5, 0}, {20, 5.5, 0}, 6);
  const auto holes = find_holes(mesh);
  ASSERT_EQ(holes.size(), 1u);
  ASSERT_TRUE(holes[0].thinnest_wall_m);
  EXPECT_NEAR(*holes[0].thinnest_wall_m, 1.5 * kMm, 0.02 * kMm);
  EXPECT_NEAR(holes[0].thinnest_at.y(), 8.5 * kMm, 0.05 * kMm);
}

TEST(FindHoles, AWallThatBrokeOutHasAnOpeningOrNoThickness) {
  // The drill's side leaves the bone along a ball's flank.
  const TriMesh mesh = drilled(test::sphere(10 * kMm, 60), {-20, 6.8, 0}, {20, 6.8, 0}, 6);
  const auto holes = find_holes(mesh);
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_TRUE(!holes[0].thinnest_wall_m || *holes[0].thinnest_wall_m < 0.3 * kMm);
}

TEST(FindHoles, TwoHolesAreTwo) {
  TriMesh mesh = drilled(test::cube(10 * kMm), {-20, 5, 5}, {20, 5, 5}, 4);
  mesh = drilled(mesh, {-4, -20, -4}, {-4, 20, -5}, 5);
  const auto holes = find_holes(mesh);
  ASSERT_EQ(holes.size(), 2u);
  EXPECT_NEAR(holes[0].diameter_m + holes[1].diameter_m, 9 * kMm, 2e-5);
}

TEST(FindHoles, AHoleThatCameOfAFieldIsFoundAsWell) {
  // Not cut by the prism: the surface of a block less a rod, on a grid.
  const auto field = [](const Vec3& p) {
    const double block = (p.cwiseAbs() - Vec3::Constant(8 * kMm)).maxCoeff();
    const double rod = std::hypot(p.x() - 1 * kMm, p.y()) - 3 * kMm;
    return std::max(block, -rod);
  };
  Aabb box;
  box.include(Vec3::Constant(-9.1 * kMm));
  box.include(Vec3::Constant(9.1 * kMm));
  IsosurfaceOptions options;
  options.cell_m = 0.4 * kMm;
  const auto mesh = isosurface(field, box, options);
  ASSERT_TRUE(mesh) << mesh.error().message();
  const auto holes = find_holes(*mesh);
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_NEAR(holes[0].diameter_m, 6 * kMm, 0.05 * kMm);
  EXPECT_NEAR(holes[0].length_m, 16 * kMm, 0.8 * kMm);  // its rims are rounded
  EXPECT_TRUE(holes[0].through);
}

// A socket of 8 mm, and a short channel of 4.5 mm from its bottom out of a slanted far side: as
// much of the channel's wall belongs to its rounded rims as to the rest.
TEST(FindHoles, AShortChannelThatLeavesThroughASlantedSideIsFound) {
  for (const double slant_deg : {0.0, 20.0, 35.0}) {
    const double turn = slant_deg * M_PI / 180;
    const Vec3 far(std::sin(turn), 0, -std::cos(turn));
    const auto field = [&](const Vec3& p) {
      const double side = std::max(std::abs(p.x()), std::abs(p.y())) - 8 * kMm;
      const double block = std::max({side, p.z() - 12 * kMm, far.dot(p) - 4 * kMm});
      const double off = std::hypot(p.x() - 0.1 * kMm, p.y() + 0.07 * kMm);
      const double socket = std::max(off - 4 * kMm, -p.z()), channel = off - 2.25 * kMm;
      return std::max(block, -std::min(socket, channel));
    };
    Aabb box;
    box.include(Vec3(-9.1, -9.1, -14.1) * kMm);
    box.include(Vec3(9.1, 9.1, 13.1) * kMm);
    IsosurfaceOptions options;
    options.cell_m = 0.4 * kMm;
    const auto mesh = isosurface(field, box, options);
    ASSERT_TRUE(mesh) << mesh.error().message();
    HoleOptions how;
    how.least_diameter_m = 4 * kMm;
    how.roundness_m = 0.3 * kMm;
    auto holes = find_holes(*mesh, how);
    ASSERT_EQ(holes.size(), 2u) << slant_deg;
    if (holes[0].diameter_m > holes[1].diameter_m) std::swap(holes[0], holes[1]);
    EXPECT_NEAR(holes[0].diameter_m, 4.5 * kMm, 0.1 * kMm) << slant_deg;
    EXPECT_NEAR(holes[1].diameter_m, 8 * kMm, 0.1 * kMm) << slant_deg;
    EXPECT_GT(std::abs(holes[0].axis.z()), 0.999) << slant_deg;
  }
}

// A drill's point leaves a cone, which is a bottom as a flat end is.
TEST(FindHoles, AHoleThatEndsInADrillsPointIsBlind) {
  const auto field = [](const Vec3& p) {
    const double block = (p.cwiseAbs() - Vec3::Constant(8 * kMm)).maxCoeff();
    const double off = std::hypot(p.x(), p.y());
    // The wall from above down to z = 0, then a point of 118 degrees.
    const double rod = std::max(off - 3 * kMm, -p.z());
    const double cone =
        std::max(off * std::sin(59 * M_PI / 180) -
                     (p.z() + 3 * kMm / std::tan(59 * M_PI / 180)) * std::cos(59 * M_PI / 180),
                 p.z());
    return std::max(block, -std::min(rod, cone));
  };
  Aabb box;
  box.include(Vec3::Constant(-9.1 * kMm));
  box.include(Vec3::Constant(9.1 * kMm));
  IsosurfaceOptions options;
  options.cell_m = 0.3 * kMm;
  const auto mesh = isosurface(field, box, options);
  ASSERT_TRUE(mesh) << mesh.error().message();
  const auto holes = find_holes(*mesh);
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_FALSE(holes[0].through);
  EXPECT_NEAR(holes[0].entry.z(), 8 * kMm, 0.5 * kMm);
  EXPECT_NEAR(holes[0].exit.z(), 0, 0.5 * kMm);
  EXPECT_LT(holes[0].axis.z(), -0.999);
}

TEST(ShareRemoved, IsThatOfTheBall) {
  const TriMesh bone = test::cube(10 * kMm);
  const MeshDistance before(bone), after(drilled(bone, {-20, 0, 0}, {20, 0, 0}, 6));
  const auto share = share_removed(before, after, Vec3(0, 3, 0) * kMm, 2 * kMm);
  ASSERT_TRUE(share);
  // A plane-like wall through the ball's middle, a little hollow.
  EXPECT_GT(*share, 0.35);
  EXPECT_LT(*share, 0.5);
  EXPECT_FALSE(share_removed(before, after, Vec3(50, 0, 0) * kMm, 2 * kMm));
  EXPECT_EQ(*share_removed(before, before, Vec3::Zero(), 2 * kMm), 0);
}

}  // namespace
}  // namespace osteon
