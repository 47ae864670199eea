// A tool that bones pinch, through the whole tick: it may go wherever no overlap grows, and what
// stops it is felt, whether it touches the tool already or leaves a gap.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collide/stepped_hole.h"
#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/base/turn.h"
#include "test_scene.h"

namespace osteon {
namespace {

using test::Rig;

constexpr double kStiffness = 2000;  // of plain_params
constexpr double kGap = 5e-5;        // between tool and jaw before they close: more than a touch

// Two jaws about the tip at the origin, each `kGap` from it.
std::vector<Bone> jaws_of_pieces() {
  const Rig probe({});
  const auto jaw = [&](double side) {
    const double reach = test::tip_reach(probe, side * Vec3::UnitZ());
    return test::bone_of(
        {test::box_hull(Vec3(0.02, 0.02, 0.005), Vec3(0, 0, side * (0.005 + reach + kGap)))});
  };
  return {jaw(-1), jaw(1)};
}

void close_jaws(Rig& rig, double by_m) {
  rig.bones.bones[0].X_WB.p.z() = by_m;
  rig.bones.bones[1].X_WB.p.z() = -by_m;
}

TEST(Pinched, AHandThatStaysWhereTheToolIsFeelsNothing) {
  Rig rig(jaws_of_pieces());
  ASSERT_FALSE(rig.at(Vec3::Zero()).status & kTickProxyBlocked);
  close_jaws(rig, 2 * kGap);
  const ToolState& s = rig.at(Vec3::Zero());
  EXPECT_TRUE(s.status & kTickProxyBlocked);
  EXPECT_TRUE(s.force_W.isZero(0));
  EXPECT_EQ(s.contact_count, 0u);
}

// In the tick in which they close, both jaws were a gap away from the tool: the push of the hand
// into one of them is felt all the same, in this tick and in those after it.
TEST(Pinched, APushIsFeltThoughTheJawWasAGapAway) {
  for (const double side : {-1.0, 1.0}) {
    Rig rig(jaws_of_pieces());
    (void)rig.at(Vec3::Zero());
    close_jaws(rig, 2 * kGap);
    constexpr double kPush = 0.001;
    for (int tick = 0; tick < 3; ++tick) {
      const ToolState& s = rig.at(Vec3(0, 0, side * kPush));
      ASSERT_TRUE(s.status & kTickProxyBlocked) << tick;
      ASSERT_LT(s.X_WP.p.norm(), 1e-6) << tick;
      ASSERT_EQ(s.contact_count, 1u) << tick;
      EXPECT_EQ(s.contacts[0].bone.index, side < 0 ? 0u : 1u) << tick;
      EXPECT_NEAR(s.force_W.z(), -side * kStiffness * kPush, 1e-6) << tick;
      EXPECT_NEAR(s.contacts[0].force_on_tool_W.z(), s.force_W.z(), 1e-9) << tick;
    }
  }
}

TEST(Pinched, ItSlidesOutBetweenTheJaws) {
  Rig rig(jaws_of_pieces());
  (void)rig.at(Vec3::Zero());
  close_jaws(rig, 2 * kGap);
  Vec3 hand = Vec3::Zero();
  for (int tick = 0; tick < 400; ++tick) {
    hand.x() += 1e-4;
    (void)rig.at(hand);
  }
  const ToolState& s = rig.at(hand);
  EXPECT_FALSE(s.status & kTickProxyBlocked);
  EXPECT_NEAR((s.X_WP.p - hand).norm(), 0, 1e-9);
}

// Bones of both kinds leap onto the tool from two sides or three, at random, as cutting lets them:
// a tool that stands still though the hand has gone on feels what holds it.
TEST(Pinched, WhatStandsStillFeelsThePush) {
  constexpr double kHalf = 0.003, kTip = 0.00075;
  const Bone of_field = test::field_bone(test::cube(kHalf));
  const Bone of_pieces = test::bone_of({test::box_hull(Vec3::Constant(kHalf))});
  Random random(5);
  int still = 0, blocked = 0;
  for (int round = 0; round < 400; ++round) {
    const Vec3 side = random.direction();
    std::vector<Vec3> sides{side, (0.2 * random.direction() - side).normalized()};
    if (round % 3 == 0) sides.push_back(random.direction());
    std::vector<Bone> bones;
    for (const Vec3& from : sides) {
      Bone bone = round % 2 == 0 ? of_field : of_pieces;
      bone.X_WB.q = turn_between(Vec3::UnitZ(), from);
      bone.X_WB.p = (kHalf + kTip + random.uniform(3e-5, 3e-4)) * from;
      bones.push_back(std::move(bone));
    }
    Rig rig(std::move(bones));
    if (rig.at(Vec3::Zero()).X_WP.p.norm() > 0) continue;
    for (std::size_t i = 0; i < sides.size(); ++i)
      rig.bones.bones[i].X_WB.p -= random.uniform(3e-4, 6e-4) * sides[i];
    const Vec3 push = 0.001 * (side + random.uniform(0, 0.2) * random.direction());
    const ToolState& s = rig.at(push);
    blocked += (s.status & kTickProxyBlocked) != 0;
    if (!(s.status & kTickProxyBlocked) || s.X_WP.p.norm() > 1e-7) continue;
    ++still;
    EXPECT_GT(s.contact_count, 0u) << round;
    EXPECT_GT(s.force_W.norm(), 0.1) << round;
  }
  std::printf("%d blocked, %d stand still\n", blocked, still);
  EXPECT_GT(still, 5);
}

// A drill fills a hole that has become 20 um too narrow for it, over a still narrower one. The
// walls beside it name planes along its way alone, so none of them holds it down there: the rim
// that does is met on the way, and the push on it is felt.
TEST(Pinched, ADrillInTooNarrowAHoleFeelsTheRimThatStopsIt) {
  constexpr double kDrill = 0.00215, kTooWide = 2e-5, kPush = 0.001;
  test::SteppedHole hole;
  const CutField roomy = hole.cuts();
  hole.wide_m = kDrill - kTooWide;
  const CutField tight = hole.cuts();
  Tool drill;
  drill.parts = {make_rod(Vec3(0, 0, kDrill), Vec3(0, 0, 0.05), kDrill)};
  Rig rig({test::field_bone(test::cube(0.008))}, drill);
  const CutField* cuts[] = {&roomy};
  rig.loop.set_cuts(cuts);
  const double rests =
      hole.step_m + std::sqrt(kDrill * kDrill - hole.narrow_m * hole.narrow_m) - kDrill;
  (void)rig.at(Vec3(0, 0, 0.02));
  (void)test::go(rig, Vec3(0, 0, 0.02), Vec3(0, 0, rests + 1e-4), 500);
  ASSERT_FALSE(rig.at(Vec3(0, 0, rests + 1e-4)).status & kTickProxyBlocked);
  const CutField* narrower[] = {&tight};
  rig.loop.set_cuts(narrower);
  double z = rests + 1e-4;
  for (int tick = 0; tick < 20; ++tick) z = rig.at(Vec3(0, 0, rests - kPush)).X_WP.p.z();
  const ToolState& s = rig.at(Vec3(0, 0, rests - kPush));
  EXPECT_TRUE(s.status & kTickProxyBlocked);
  EXPECT_EQ(s.X_WP.p.z(), z) << "it stands still";
  EXPECT_GT(z, rests - 2.5e-4) << "splines over cells of 0.4 mm round the rim";
  ASSERT_EQ(s.contact_count, 1u);
  EXPECT_NEAR(s.force_W.z(), kStiffness * (z - (rests - kPush)), 1e-3);
}

// Two plates that stand on edge and lean apart, each by `half_angle`.
std::vector<Bone> wedge(double half_angle) {
  const auto plate = [&](double side) {
    const Vec3 n(-side * std::cos(half_angle), 0, std::sin(half_angle));
    Pose X_WB;
    X_WB.q = Quat::FromTwoVectors(Vec3::UnitZ(), n);
    X_WB.p = -0.005 * n;
    return test::bone_of({test::box_hull(Vec3(0.08, 0.08, 0.005))}, X_WB);
  };
  return {plate(-1), plate(1)};
}

// Down between the plates until the hand feels more than a newton.
const ToolState& push_between(Rig& rig) {
  Vec3 hand(0, 0, 0.06);
  (void)rig.at(hand);
  while (hand.z() > 0 && rig.at(hand).force_W.norm() < 1) hand.z() -= 1e-4;
  return rig.at(hand);
}

TEST(Pinched, InAWideWedgeTheWallsShareTheForceAsStaticsSays) {
  for (const double half_angle : {0.35, 0.8}) {
    Rig rig(wedge(half_angle));
    const ToolState& s = push_between(rig);
    ASSERT_EQ(s.contact_count, 2u) << half_angle;
    for (std::uint32_t i = 0; i < 2; ++i)
      EXPECT_NEAR(s.contacts[i].force_on_tool_W.norm(),
                  s.force_W.norm() / (2 * std::sin(half_angle)), 0.02 * s.force_W.norm())
          << half_angle;
  }
}

// Without a bound a push of 1 N would count as 29 N on either wall.
TEST(Pinched, InANarrowWedgeNoWallCountsForMoreThanThreeTimesWhatIsFelt) {
  Rig rig(wedge(0.0175));
  const ToolState& s = push_between(rig);
  ASSERT_GT(s.force_W.norm(), 1);
  ASSERT_EQ(s.contact_count, 2u);
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_LE(s.contacts[i].force_on_tool_W.norm(), 3.001 * s.force_W.norm());
    EXPECT_GT(s.contacts[i].force_on_tool_W.norm(), 2.9 * s.force_W.norm());
  }
}

}  // namespace
}  // namespace osteon
