// Bones felt as distance fields, through the whole tick. The mesh itself is the oracle.
#include "field_walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/isosurface.h"
#include "test_scene.h"

namespace osteon {
namespace {

using test::Rig;

constexpr double kTip = 0.00075;
constexpr double kStiffness = 2000;  // of plain_params

TriMesh grown(const ScalarField& field, const Vec3& half) {
  IsosurfaceOptions options;
  options.cell_m = 0.0005;
  return std::move(isosurface(field, {-half, half}, options).value());
}

// A block with a round groove of 3 mm radius along y.
TriMesh groove() {
  return grown(
      [](const Vec3& p) {
        const Vec3 q = p.cwiseAbs() - Vec3(0.005, 0.004, 0.002);
        const double block = q.cwiseMax(0.0).norm() + std::min(0.0, q.maxCoeff());
        const double bore = 0.003 - std::hypot(p.x(), p.z() - 0.003);
        return std::max(block, bore);
      },
      Vec3(0.006, 0.005, 0.003));
}

TEST(FieldWalls, WhatIsNotANumberGivesNoForce) {
  Rig rig({test::field_bone(test::cube(0.004))});
  rig.at(Vec3(0, 0, 0.006));
  ASSERT_GT(test::go(rig, Vec3(0, 0, 0.006), Vec3(0, 0, 0.0042), 50).force_W.z(), 0.5);
  const ToolState& s = rig.at(Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0.0042));
  EXPECT_TRUE(s.force_W.isZero(0));
  EXPECT_TRUE(s.status & kTickInputNotFinite);
}

TEST(FieldWalls, FarAwayNothingIsFelt) {
  Rig rig({test::field_bone(test::cube(0.004))});
  rig.at(Vec3(0.3, 0, 0));
  const ToolState& s = test::go(rig, Vec3(0.3, 0, 0), Vec3(0.02, 0.1, 0.03), 100);
  EXPECT_TRUE(s.force_W.isZero(0));
  EXPECT_EQ(s.contact_count, 0u);
  EXPECT_EQ(s.X_WP.p, s.X_WD.p);
}

TEST(FieldWalls, AHandThatStartsInsideIsPutOutAndNotKicked) {
  Rig rig({test::field_bone(test::cube(0.004))});
  const ToolState& s = rig.at(Vec3(0, 0, 0.0036));
  EXPECT_TRUE(s.force_W.isZero(0));
  EXPECT_GE(s.X_WP.p.z(), 0.004 + kTip - 1e-6);
}

TEST(FieldWalls, ExactlyOnTheSurfaceTheForceIsNothing) {
  Rig rig({test::field_bone(test::cube(0.004))});
  rig.at(Vec3(0, 0, 0.006));
  const ToolState& s = test::go(rig, Vec3(0, 0, 0.006), Vec3(0, 0, 0.004 + kTip), 100);
  EXPECT_LT(s.force_W.norm(), kStiffness * 1e-5);
}

TEST(FieldWalls, PressingAFlatFaceGivesStiffnessTimesDepth) {
  Rig rig({test::field_bone(test::cube(0.004))});
  rig.at(Vec3(0, 0, 0.006));
  const double depth = 0.0008;
  const ToolState& s =
      test::go(rig, Vec3(0, 0, 0.006), Vec3(0.0005, -0.001, 0.004 + kTip - depth), 200);
  EXPECT_NEAR(s.force_W.z(), kStiffness * depth, kStiffness * 1e-5);
  EXPECT_LT(s.force_W.head<2>().norm(), 0.01);
  ASSERT_EQ(s.contact_count, 1u);
  EXPECT_NEAR(s.contacts[0].p_W.z(), 0.004, 2e-5);
  EXPECT_NEAR(s.contacts[0].depth_m, depth, 1e-5);
}

TEST(FieldWalls, AHandThatJumpsDoesNotPassAThinPlate) {
  TriMesh plate = test::cube(0.004);
  for (Vec3& v : plate.vertices) v.z() *= 0.1;
  Rig rig({test::field_bone(plate)});
  rig.at(Vec3(0, 0, 0.010));
  for (int i = 0; i < 200; ++i) {
    const ToolState& s = rig.at(Vec3(0, 0, -0.010));
    ASSERT_GT(s.X_WP.p.z(), 0.0004 + kTip - 1e-5) << i;
  }
}

// The tip in a groove of 3 mm rests on the bottom; the ball's centre 2.25 mm from the bore's axis.
TEST(FieldWalls, AGrooveIsFeltToItsBottom) {
  Rig rig({test::field_bone(groove())});
  rig.at(Vec3(0, 0, 0.006));
  test::go(rig, Vec3(0, 0, 0.006), Vec3(0.0004, 0, -0.0005), 200);
  for (int i = 0; i < 20; ++i) rig.at(Vec3(0, 0, -0.0005));
  const ToolState& s = rig.at(Vec3(0, 0, -0.0005));
  EXPECT_NEAR(s.X_WP.p.z(), kTip, 3e-5);
  EXPECT_NEAR(s.X_WP.p.x(), 0, 5e-5);
}

TEST(FieldWalls, ASharpCornerOfTwoBonesHoldsTheProxyInIt) {
  const Vec3 wall(0.008, 0, 0.004);
  Rig rig({test::field_bone(test::cube(0.004, Vec3(0, 0, -0.004))),
           test::field_bone(test::cube(0.004), {wall, Quat::Identity()})});
  rig.at(Vec3(0, 0, 0.004));
  test::go(rig, Vec3(0, 0, 0.004), Vec3(0.0045, 0, -0.0005), 300);
  const ToolState& s = rig.at(Vec3(0.0045, 0, -0.0005));
  EXPECT_NEAR(s.X_WP.p.x(), 0.004 - kTip, 2e-5);
  EXPECT_NEAR(s.X_WP.p.z(), kTip, 2e-5);
  EXPECT_GT(s.force_W.z(), 0.5);
  EXPECT_LT(s.force_W.x(), -0.5);
}

// Both walls belong to one bone: its own field must hold two planes.
TEST(FieldWalls, ASharpCornerOfOneBoneHoldsTheProxyInIt) {
  const TriMesh step = grown(
      [](const Vec3& p) {
        const double floor = p.z() + 0.001;
        const double wall = 0.001 - p.x();
        const Vec3 q = p.cwiseAbs() - Vec3(0.004, 0.004, 0.004);
        return std::max(std::min(floor, wall), q.maxCoeff());
      },
      Vec3::Constant(0.005));
  Rig rig({test::field_bone(step)});
  rig.at(Vec3(-0.0015, 0, 0.002));
  test::go(rig, Vec3(-0.0015, 0, 0.002), Vec3(0.0012, 0, -0.0012), 300);
  const ToolState& s = rig.at(Vec3(0.0012, 0, -0.0012));
  EXPECT_NEAR(s.X_WP.p.x(), 0.001 - kTip, 1e-4);
  EXPECT_NEAR(s.X_WP.p.z(), -0.001 + kTip, 1e-4);
}

TEST(FieldWalls, AWanderingHandNeverBringsTheTipIntoBone) {
  const TriMesh mesh = groove();
  const MeshDistance truth(mesh);
  Rig rig({test::field_bone(mesh, {}, {2000, 0.3, 0.2})});
  rig.params = HapticParams{};
  Random random(11);
  Vec3 hand(0, 0, 0.006);
  rig.at(hand);
  int contacts = 0;
  double deepest = 1;
  for (int i = 0; i < 6000; ++i) {
    const Vec3 step = random.direction();
    hand += 0.0003 * step;
    if (hand.norm() > 0.007) hand *= 0.8;
    const ToolState& s = rig.at(hand);
    contacts += s.contact_count > 0;
    deepest = std::min(deepest, truth.closest(s.X_WP.p).signed_distance - kTip);
    ASSERT_FALSE(s.status & (kTickProxyBlocked | kTickSolverLimit)) << i;
  }
  EXPECT_GT(contacts, 2000);
  // The splines round the block's sharp edges off by some micrometres.
  EXPECT_GT(deepest, -4e-5);
}

TEST(FieldWalls, ABoneThatMovesCarriesTheProxyAlong) {
  Rig rig({test::field_bone(test::cube(0.004), {}, {1e4, 0.5, 0.4})});
  rig.at(Vec3(0, 0, 0.006));
  test::go(rig, Vec3(0, 0, 0.006), Vec3(0, 0, 0.0045), 50);
  for (int i = 0; i < 200; ++i) {
    rig.bones.bones[0].X_WB.p.z() += 2e-5;
    const ToolState& s = rig.at(Vec3(0, 0, 0.0045));
    ASSERT_GE(s.X_WP.p.z(), rig.bones.bones[0].X_WB.p.z() + 0.004 + kTip - 2e-6) << i;
  }
}

// The same stroke gives the same bits from a saved state.
TEST(FieldWalls, ASavedStateGoesOnAsItWas) {
  Rig rig({test::field_bone(groove(), {}, {2000, 0.3, 0.2})});
  rig.at(Vec3(0, 0, 0.006));
  test::go(rig, Vec3(0, 0, 0.006), Vec3(0.001, 0.001, 0.0002), 100);
  const auto saved = rig.loop.save();
  test::go(rig, Vec3(0.001, 0.001, 0.0002), Vec3(-0.003, -0.002, 0.0015), 100);
  const std::uint64_t once = rig.loop.state_hash();
  rig.loop.restore(*saved);
  test::go(rig, Vec3(0.001, 0.001, 0.0002), Vec3(-0.003, -0.002, 0.0015), 100);
  EXPECT_EQ(rig.loop.state_hash(), once);
}

// A tip that is thicker than the field's fine band is a true ball too.
TEST(FieldWalls, AThickTipStandsOffByItsRadius) {
  Rig rig({test::field_bone(test::cube(0.004))}, make_wrist_probe(0.003));
  rig.at(Vec3(0, 0, 0.010));
  const ToolState& s = test::go(rig, Vec3(0, 0, 0.010), Vec3(0, 0, 0.0062), 100);
  EXPECT_NEAR(s.force_W.z(), kStiffness * (0.004 + 0.003 - 0.0062), 0.05);
}

}  // namespace
}  // namespace osteon
