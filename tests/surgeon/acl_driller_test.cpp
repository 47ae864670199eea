#include "osteon/surgeon/acl_driller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace osteon {
namespace {

using MoveKind = AclMove::Kind;

// A tip that goes down through stuff which lets it through by force, with grip and coupling as
// springs in a row.
struct SoftStuff {
  double tip_m = 0.005;
  double m_per_s_n = 0.002;  // how fast, by newton
  Vec3 force(const Pose& wanted, double dt_s) {
    const double give = 1.0 / 500 + 1.0 / 2000;
    const double press_n = std::max(0.0, (tip_m - wanted.p.z()) / give);
    if (tip_m > 0)
      tip_m = std::max(0.0, wanted.p.z());
    else
      tip_m -= m_per_s_n * press_n * dt_s;
    return tip_m > 0 ? Vec3(Vec3::Zero())
                     : Vec3(0, 0, std::max(0.0, (tip_m - wanted.p.z()) / give));
  }
};

std::vector<AclMove> down_to(double z_m, double force_n, bool exact) {
  const Pose above{Vec3(0, 0, 0.005), Quat::Identity()};
  const Pose end{Vec3(0, 0, z_m), Quat::Identity()};
  return {{MoveKind::kGo, above, 0.1},
          {MoveKind::kTake, {}, 0, 0, 0, "cannulated_drill:8"},
          {MoveKind::kPower, {}, 0, 0, 1},
          {MoveKind::kPress, end, 0.02, force_n, 60, {}, exact}};
}

TEST(AclDriller, PressesWithItsForceAndStopsWhereItShould) {
  AclDriller hand(down_to(-0.02, 2, true), expert_skill());
  hand.set_tray({"guide_pin", "cannulated_drill:8"});
  SoftStuff stuff;
  std::vector<Command> commands;
  double most_n = 0;
  int ticks = 0;
  while (!hand.done() && ++ticks < 60000) {
    const Pose wanted = hand.step(0.001);
    if (const Command c = hand.command(); c.kind != CommandKind::kNone) commands.push_back(c);
    const Vec3 force = stuff.force(wanted, 0.001);
    most_n = std::max(most_n, force.z());
    hand.feel(force);
  }
  ASSERT_TRUE(hand.done());
  EXPECT_EQ(hand.given_up(), 0u);
  EXPECT_NEAR(stuff.tip_m, -0.02, 0.0005);
  EXPECT_NEAR(most_n, 2, 0.4);
  ASSERT_EQ(commands.size(), 2u);
  EXPECT_EQ(commands[0].kind, CommandKind::kTake);
  EXPECT_EQ(commands[0].value, 1);
  EXPECT_EQ(commands[1].kind, CommandKind::kPower);
}

TEST(AclDriller, GivesUpWhereNothingLetsItThrough) {
  auto moves = down_to(-0.02, 2, false);
  moves.back().value = 3;
  AclDriller hand(moves, expert_skill());
  SoftStuff stuff;
  stuff.m_per_s_n = 0;
  double highest_m = 0;
  int ticks = 0;
  while (!hand.done() && ++ticks < 20000) {
    const Pose wanted = hand.step(0.001);
    if (ticks > 3000) highest_m = std::max(highest_m, wanted.p.z());
    hand.feel(stuff.force(wanted, 0.001));
  }
  EXPECT_TRUE(hand.done());
  EXPECT_GT(highest_m, 0.05) << "drawn back far before it is given up";
  EXPECT_NEAR(ticks, 1e3 * (3 + 2 * (3 + 1.5)), 1000);
  EXPECT_EQ(hand.given_up(), 1u);
  hand.feel(Vec3(NAN, 0, 0));
  EXPECT_TRUE(is_finite(hand.step(0.001)));
}

// Something wedges before the tip and stays there until the drill has been drawn back.
TEST(AclDriller, WhatGoesNoFartherIsDrawnBackAndPressedAgain) {
  AclDriller hand(down_to(-0.02, 2, false), expert_skill());
  SoftStuff stuff;
  bool wedged = false, freed = false;
  int ticks = 0;
  while (!hand.done() && ++ticks < 60000) {
    const Pose wanted = hand.step(0.001);
    if (!freed && stuff.tip_m < -0.01) wedged = true;
    if (wedged && wanted.p.z() > -0.001) freed = true;
    stuff.m_per_s_n = wedged && !freed ? 0 : 0.002;
    hand.feel(stuff.force(wanted, 0.001));
  }
  ASSERT_TRUE(hand.done());
  EXPECT_TRUE(wedged && freed);
  EXPECT_EQ(hand.given_up(), 0u);
  EXPECT_NEAR(stuff.tip_m, -0.02, 0.0005);
  EXPECT_LT(ticks, 40000) << "long before its time is over";
}

// What only a drill that comes from far back gets rid of.
TEST(AclDriller, BeforeItIsGivenUpItComesFromFarBack) {
  auto moves = down_to(-0.02, 2, false);
  moves.back().value = 12;
  AclDriller hand(moves, expert_skill());
  SoftStuff stuff;
  bool freed = false;
  int ticks = 0;
  while (!hand.done() && ++ticks < 60000) {
    const Pose wanted = hand.step(0.001);
    freed = freed || (stuff.tip_m < -0.009 && wanted.p.z() > 0.03);
    stuff.m_per_s_n = stuff.tip_m < -0.01 && !freed ? 0 : 0.002;
    hand.feel(stuff.force(wanted, 0.001));
  }
  EXPECT_TRUE(freed);
  EXPECT_EQ(hand.given_up(), 0u);
  EXPECT_NEAR(stuff.tip_m, -0.02, 0.0005);
}

// Slippery bone: z = slope x. The tip slides down it as it is pressed along z.
struct Slope {
  double slope = 0.6;
  Vec3 tip_W = Vec3::Zero();
  Vec3 force(const Vec3& wanted_W) {
    const double give = 1.0 / 500 + 1.0 / 2000;
    const Vec3 normal = Vec3(-slope, 0, 1).normalized();
    const double deep = std::max(0.0, -normal.dot(wanted_W));
    tip_W = wanted_W + deep * normal;
    return deep / give * normal;
  }
};

std::vector<AclMove> leaning(double at_x_m, double for_s) {
  const Pose above{Vec3(at_x_m, 0, 0.6 * at_x_m + 0.002), Quat::Identity()};
  AclMove lean{MoveKind::kLean, above, 0.01, 2, for_s};
  lean.out_W = Vec3::UnitZ();
  return {{MoveKind::kGo, above, 0.1}, lean};
}

// The slide of a hand that only presses: force times give times slope, away from the line.
TEST(AclDriller, LeansAgainstSlantedBoneUntilTheTipIsOnTheLine) {
  constexpr double kLine_m = 0.004;
  AclDriller hand(leaning(kLine_m, 30), expert_skill());
  Slope bone;
  Vec3 force = Vec3::Zero();
  double farthest_m = 0;
  for (int n = 0; n < 30000 && !hand.done(); ++n) {
    force = bone.force(hand.step(0.001).p);
    hand.feel(force);
    farthest_m = std::max(farthest_m, std::abs(bone.tip_W.x() - kLine_m));
  }
  ASSERT_TRUE(hand.done());
  EXPECT_EQ(hand.given_up(), 0u);
  EXPECT_GT(farthest_m, 0.0002);
  EXPECT_NEAR(bone.tip_W.x(), kLine_m, 0.0003);
  EXPECT_NEAR(bone.tip_W.z(), 0.6 * kLine_m, 0.0003);
  EXPECT_NEAR(force.z(), 2, 0.5);
}

TEST(AclDriller, LeansNoLongerThanItsTimeWhereThereIsNoBone) {
  AclDriller hand(leaning(0, 2), expert_skill());
  int ticks = 0;
  while (!hand.done() && ++ticks < 10000) {
    hand.step(0.001);
    hand.feel(Vec3::Zero());
  }
  ASSERT_TRUE(hand.done());
  EXPECT_EQ(hand.given_up(), 1u);
  EXPECT_NEAR(ticks, 2000, 20);
}

}  // namespace
}  // namespace osteon
