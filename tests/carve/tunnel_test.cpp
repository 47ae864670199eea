#include "osteon/carve/tunnel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/measure.h"
#include "tunnel_oracle.h"

namespace osteon {
namespace {

using test::cgal_volume_less_cylinder;
using test::cube;
using test::faults_of;
using test::joined;
using test::sphere;

constexpr double kMillimetre = 1e-3;

struct Drilled {
  TunnelPlan plan;
  TunnelCut cut;
};

Drilled drill(const TriMesh& bone, const Vec3& from_mm, const Vec3& to_mm, double diameter_mm) {
  auto plan =
      plan_tunnel(bone, {from_mm * kMillimetre, to_mm * kMillimetre, diameter_mm * kMillimetre});
  EXPECT_TRUE(plan) << plan.error().message();
  if (!plan) return {};
  auto cut = advance(*plan, plan->length_m);
  EXPECT_TRUE(cut) << cut.error().message();
  return {*plan, cut ? *cut : TunnelCut{}};
}

double cylinder_mm3(double diameter_mm, double length_mm) {
  return M_PI / 4 * diameter_mm * diameter_mm * length_mm;
}

/// A cube of 20 mm about the origin.
TriMesh small_cube() { return cube(10 * kMillimetre); }

TEST(Tunnel, RefusesALineThatIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(plan_tunnel(small_cube(), {Vec3::Zero(), Vec3::Zero(), 0.005}));
  EXPECT_FALSE(plan_tunnel(small_cube(), {Vec3(nan, 0, 0), Vec3::UnitX(), 0.005}));
  EXPECT_FALSE(plan_tunnel(small_cube(), {Vec3::Zero(), Vec3::UnitX(), nan}));
  EXPECT_FALSE(plan_tunnel(small_cube(), {Vec3::Zero(), Vec3::UnitX(), 0}));
  EXPECT_FALSE(plan_tunnel(small_cube(), {Vec3::Zero(), Vec3::UnitX(), -0.005}));
}

TEST(Tunnel, RefusesABoneThatIsOpenOrEmpty) {
  TriMesh open = small_cube();
  open.triangles.pop_back();
  const auto plan = plan_tunnel(open, {Vec3(0, 0, -1), Vec3(0, 0, 1), 0.005});
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message().find("not closed"), std::string::npos);
  EXPECT_FALSE(plan_tunnel({}, {Vec3(0, 0, -1), Vec3(0, 0, 1), 0.005}));
}

TEST(Tunnel, ThroughACubeAlongAnAxisItsDiagonalAndThroughEdgesAndCorners) {
  struct Line {
    Vec3 from_mm, to_mm;
  };
  const Line lines[] = {{{0, 0, -20}, {0, 0, 20}},  // the axis meets the diagonals of two faces
                        {{3, 1, -20}, {3, 1, 20}},
                        {{-30, -30, -30}, {30, 30, 30}},  // through two corners
                        {{-30, -30, 0}, {30, 30, 0}},     // through the middles of two edges
                        {{10, 10, -20}, {10, 10, 20}},    // along an edge
                        {{10, 0, -20}, {10, 0, 20}},      // in a face
                        {{7.5, 0, -20}, {7.5, 0, 20}},    // the wall touches a face
                        {{7.5, 7.5, -20}, {7.5, 7.5, 20}}};
  for (const Line& line : lines) {
    const Drilled d = drill(small_cube(), line.from_mm, line.to_mm, 5);
    EXPECT_EQ(faults_of(small_cube(), d.plan, d.cut), "") << line.from_mm.transpose();
    EXPECT_EQ(d.cut.bottom_m2, 0) << line.from_mm.transpose();
    const double expected =
        volume(small_cube()) - cgal_volume_less_cylinder(small_cube(), line.from_mm * kMillimetre,
                                                         line.to_mm * kMillimetre, 5 * kMillimetre);
    EXPECT_NEAR(d.cut.removed_m3 / expected, 1, 1e-3) << line.from_mm.transpose();
  }
}

TEST(Tunnel, HasTheVolumeOfItsCylinder) {
  const Drilled d = drill(small_cube(), {1, 2, -20}, {1, 2, 20}, 9);
  EXPECT_NEAR(d.cut.removed_m3 * 1e9 / cylinder_mm3(9, 20), 1, 2e-4);
  EXPECT_EQ(d.plan.rims.size(), 2u);
  ASSERT_EQ(d.plan.passes.size(), 1u);
  EXPECT_NEAR(d.plan.passes[0].entry_m, 10 * kMillimetre, 1e-12);
  EXPECT_NEAR(drilled_length(d.plan, d.plan.length_m), 20 * kMillimetre, 1e-12);
}

TEST(Tunnel, EndsFlatInBone) {
  const Drilled d = drill(small_cube(), {1, 2, -20}, {1, 2, 3}, 6);
  EXPECT_EQ(faults_of(small_cube(), d.plan, d.cut), "");
  EXPECT_NEAR(d.cut.removed_m3 * 1e9 / cylinder_mm3(6, 13), 1, 2e-4);
  EXPECT_NEAR(d.cut.bottom_m2 * 1e6, M_PI * 9, 0.01);
  EXPECT_EQ(d.cut.rims.size(), 1u);
}

TEST(Tunnel, ThatBeginsAndEndsInBoneIsAVoid) {
  const Drilled d = drill(small_cube(), {1, 2, -4}, {1, 3, 3}, 6);
  EXPECT_EQ(faults_of(small_cube(), d.plan, d.cut), "");
  EXPECT_NEAR(d.cut.removed_m3 * 1e9 / cylinder_mm3(6, std::sqrt(50.0)), 1, 2e-4);
  EXPECT_TRUE(d.cut.rims.empty());
  EXPECT_EQ(topology(drilled_bone(d.plan, d.cut)).components, 2u);
}

TEST(Tunnel, FromAPointOfTheSurfaceLeavesNoFilm) {
  const Drilled d = drill(small_cube(), {1, 2, -10}, {1, 2, 10}, 6);
  EXPECT_EQ(faults_of(small_cube(), d.plan, d.cut), "");
  EXPECT_EQ(d.cut.bottom_m2, 0);
  EXPECT_NEAR(d.cut.removed_m3 * 1e9 / cylinder_mm3(6, 20), 1, 3e-4);
}

TEST(Tunnel, AnEndHalfInBoneIsCutByThePlaneOfTheEnd) {
  for (const double tilt : {0.0, 0.3, 1.0}) {
    const Vec3 from(0, 0.5, -10 - 0.2), to(4 * tilt, 8 * tilt + 0.5, 4);
    const Drilled d = drill(small_cube(), from, to, 8);
    EXPECT_EQ(faults_of(small_cube(), d.plan, d.cut), "") << tilt;
    const double expected =
        volume(small_cube()) - cgal_volume_less_cylinder(small_cube(), from * kMillimetre,
                                                         to * kMillimetre, 8 * kMillimetre);
    EXPECT_NEAR(d.cut.removed_m3 / expected, 1, 1e-3) << tilt;
  }
}

TEST(Tunnel, ThatMissesTakesNothing) {
  const Drilled d = drill(small_cube(), {30, 0, -20}, {30, 0, 20}, 9);
  EXPECT_EQ(d.cut.removed_m3, 0);
  EXPECT_TRUE(d.plan.rims.empty());
  EXPECT_TRUE(d.plan.passes.empty());
  EXPECT_EQ(drilled_bone(d.plan, d.cut).triangles, small_cube().triangles);
}

TEST(Tunnel, LargerThanTheBoneTakesAllOfIt) {
  const Drilled d = drill(small_cube(), {0, 0, -20}, {0, 0, 20}, 60);
  EXPECT_NEAR(d.cut.removed_m3, volume(small_cube()), 1e-18);
  EXPECT_TRUE(drilled_bone(d.plan, d.cut).triangles.empty());
}

TEST(Tunnel, GoesThroughSeveralPartsOfABone) {
  const TriMesh two = joined(sphere(8 * kMillimetre, 20, Vec3(-10, 0, 0) * kMillimetre),
                             sphere(8 * kMillimetre, 20, Vec3(10, 0, 0) * kMillimetre));
  const Vec3 from(-30, 1, 0.5), to(30, -1, 0.2);
  const Drilled d = drill(two, from, to, 5);
  EXPECT_EQ(faults_of(two, d.plan, d.cut), "");
  EXPECT_EQ(d.plan.rims.size(), 4u);
  EXPECT_EQ(d.plan.passes.size(), 2u);
  const double expected =
      volume(two) -
      cgal_volume_less_cylinder(two, from * kMillimetre, to * kMillimetre, 5 * kMillimetre);
  EXPECT_NEAR(d.cut.removed_m3 / expected, 1, 1e-3);
}

TEST(Tunnel, DrilledTwiceIsTheSame) {
  const Drilled once = drill(small_cube(), {1, 2, -20}, {1, 2, 3}, 6);
  const TriMesh bone = drilled_bone(once.plan, once.cut);
  const Drilled again = drill(bone, {1, 2, -20}, {1, 2, 3}, 6);
  EXPECT_EQ(faults_of(bone, again.plan, again.cut), "");
  EXPECT_LT(again.cut.removed_m3 * 1e9, 0.002 * cylinder_mm3(6, 13));
  const Drilled deeper = drill(bone, {1, 2, -20}, {1, 2, 20}, 6);
  EXPECT_EQ(faults_of(bone, deeper.plan, deeper.cut), "");
  EXPECT_NEAR(deeper.cut.removed_m3 * 1e9 / cylinder_mm3(6, 7), 1, 2e-3);
}

TEST(Tunnel, CrossesAnotherTunnel) {
  const Drilled first = drill(small_cube(), {-20, 2, 1}, {20, 2, 1}, 6);
  const TriMesh bone = drilled_bone(first.plan, first.cut);
  const Drilled second = drill(bone, {1, -20, 2}, {1, 20, 0}, 5);
  EXPECT_EQ(faults_of(bone, second.plan, second.cut), "");
  const double expected =
      volume(bone) - cgal_volume_less_cylinder(bone, Vec3(1, -20, 2) * kMillimetre,
                                               Vec3(1, 20, 0) * kMillimetre, 5 * kMillimetre);
  EXPECT_NEAR(second.cut.removed_m3 / expected, 1, 1e-3);
}

TEST(Tunnel, AdvanceEqualsATunnelThatEndsThere) {
  const TriMesh ball = sphere(10 * kMillimetre, 30);
  const auto plan = plan_tunnel(
      ball, {Vec3(-20, 1, 2) * kMillimetre, Vec3(20, 0, 0) * kMillimetre, 5 * kMillimetre});
  ASSERT_TRUE(plan);
  const Vec3 along = (plan->line.to - plan->line.from).normalized();
  double before = 0;
  for (double depth_mm = 0; depth_mm < 40; depth_mm += 2.9) {
    const auto cut = advance(*plan, depth_mm * kMillimetre);
    ASSERT_TRUE(cut);
    EXPECT_EQ(faults_of(ball, *plan, *cut), "") << depth_mm;
    EXPECT_GE(cut->removed_m3, before - 1e-14);
    before = cut->removed_m3;
    if (std::abs(depth_mm - 20.3) > 0.1) continue;
    const double expected =
        volume(ball) - cgal_volume_less_cylinder(ball, plan->line.from,
                                                 plan->line.from + depth_mm * kMillimetre * along,
                                                 5 * kMillimetre);
    EXPECT_NEAR(cut->removed_m3, expected, 1e-3 * expected + 1e-15) << depth_mm;
  }
}

TEST(Tunnel, OfRandomLinesThroughABall) {
  const TriMesh ball = sphere(10 * kMillimetre, 24);
  Random random(7);
  for (int i = 0; i < 10; ++i) {
    const auto point = [&random] {
      const double x = random.uniform(-16, 16), y = random.uniform(-16, 16);
      const double z = random.uniform(-16, 16);
      return Vec3(x, y, z);
    };
    const Vec3 from = point(), to = point();
    const double diameter = random.uniform(1, 9);
    const Drilled d = drill(ball, from, to, diameter);
    EXPECT_EQ(faults_of(ball, d.plan, d.cut), "") << i;
    if (i % 3 != 0) continue;  // the oracle takes its time
    const double expected =
        volume(ball) - cgal_volume_less_cylinder(ball, from * kMillimetre, to * kMillimetre,
                                                 diameter * kMillimetre);
    EXPECT_NEAR(d.cut.removed_m3, expected, 1e-3 * expected + 1e-14) << i;
  }
}

}  // namespace
}  // namespace osteon
