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
  for (int n = 0; n < 6000 && !hand.done(); ++n) {
    const Pose wanted = hand.step(0.001);
    hand.feel(stuff.force(wanted, 0.001));
  }
  EXPECT_TRUE(hand.done());
  EXPECT_EQ(hand.given_up(), 1u);
  hand.feel(Vec3(NAN, 0, 0));
  EXPECT_TRUE(is_finite(hand.step(0.001)));
}

}  // namespace
}  // namespace osteon
