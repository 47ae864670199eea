// An awl in a session: pushed and turned to and fro by the hand, and what its hole is good for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drilling.h"
#include "osteon/carve/removed.h"
#include "osteon/scene/carve_events.h"

namespace osteon {
namespace {

using testing::Drilling;
using testing::kTop_m;

constexpr double kAwlDeep_m = 0.003;  // that the hand wants to go

// Straight down on the middle of the top, turned to and fro by `turn_rad` 1.5 times a second.
HandInput awl_at(int n, double turn_rad, double deepest = kAwlDeep_m) {
  const double t = 0.001 * n;
  HandInput hand;
  hand.input.X_WD.p = {0, 0, kTop_m + std::max(0.001 - 0.004 * t, -deepest)};
  const double angle = turn_rad * std::sin(2 * std::numbers::pi * 1.5 * t);
  hand.input.X_WD.q = Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  return hand;
}

double awl_gone_mm3(const Session& session) {
  return 1e9 * total(removed_volume(*session.carving()->field(0)));
}

double deep_m(const Session& session) { return kTop_m - session.tool_state().X_WP.p.z(); }

TEST(Awl, GoesInAsTheHandTurnsIt) {
  Drilling with("awl:8");
  Session still = with.session(), turned = with.session();
  for (int n = 1; n <= 4500; ++n) {
    const HandInput at_rest = awl_at(n, 0, 0.006), turning = awl_at(n, 0.7, 0.006);
    (void)still.tick(std::span(&at_rest, 1));
    (void)turned.tick(std::span(&turning, 1));
  }
  EXPECT_LT(awl_gone_mm3(still), 0.01);
  EXPECT_GT(deep_m(turned), 0.005);
  // The hole is the awl's cone, as deep as its tip stands.
  const double slope = std::tan(15 * std::numbers::pi / 180);
  const double cone = std::numbers::pi / 3 * slope * slope * std::pow(1000 * deep_m(turned), 3);
  EXPECT_NEAR(awl_gone_mm3(turned), cone, 0.05 * cone);
}

// It sticks and slips by less than a twentieth of a millimetre: what the hand feels never falls by
// more than its spring over that way.
TEST(Awl, GoesOnInSmallSlips) {
  const Drilling with("awl:8");
  Session session = with.session();
  int sticks = 0, slips = 0;
  double last_z = 0, last_f = 0, largest_fall = 0;
  for (int n = 1; n <= 2500; ++n) {
    const HandInput hand = awl_at(n, 0.7, 0.006);
    (void)session.tick(std::span(&hand, 1));
    const ToolState& tool = session.tool_state();
    if (n > 700) {
      const bool moved = tool.X_WP.p.z() < last_z;
      slips += moved ? 1 : 0;
      sticks += !moved && (tool.status & kTickSticking) != 0 ? 1 : 0;
      largest_fall = std::max(largest_fall, last_f - tool.force_W.z());
    }
    last_z = tool.X_WP.p.z();
    last_f = tool.force_W.z();
  }
  EXPECT_GT(deep_m(session), 0.003);
  EXPECT_GT(sticks, 300);
  EXPECT_GT(slips, 50);
  EXPECT_LT(largest_fall, 5e-5 * with.settings.haptic.stiffness_n_per_m + 0.02);
}

// What a drill of 2 mm does that is put on slanted by 50 degrees, where an awl was or was not.
struct SlantedStart {
  bool skives = false;
  double drilled_mm3 = 0;
};

SlantedStart drill_slanted(bool awl_first) {
  Drilling with("awl:8");
  with.also("drill:2");
  Session session = with.session();
  int n = 1;
  for (; awl_first && n <= 3500; ++n) {
    const HandInput hand = awl_at(n, 0.7);
    (void)session.tick(std::span(&hand, 1));
  }
  SlantedStart out;
  const double before = awl_gone_mm3(session);
  const Quat q(Eigen::AngleAxisd(50 * std::numbers::pi / 180, Vec3::UnitY()));
  const Vec3 back = q * Vec3::UnitZ();
  for (int k = 0; k <= 3000; ++k) {
    HandInput hand;
    hand.input.X_WD.q = q;
    hand.input.X_WD.p =
        Vec3(0, 0, kTop_m - 0.0005) + std::max(0.006 - 0.005 * 0.001 * k, -0.003) * back;
    if (k < 20) hand.input.X_WD.p = {0, 0, kTop_m + 0.01};
    if (k == 5) hand.command = {CommandKind::kTake, 1};
    if (k == 10) hand.command = {CommandKind::kPower, 1};
    (void)session.tick(std::span(&hand, 1));
    for (const Event& event : session.last_events()) out.skives |= event.kind == kSkives;
  }
  out.drilled_mm3 = awl_gone_mm3(session) - before;
  return out;
}

TEST(Awl, ItsHoleHoldsADrillThatWouldSkive) {
  const SlantedStart bare = drill_slanted(false), started = drill_slanted(true);
  EXPECT_TRUE(bare.skives);
  EXPECT_LT(bare.drilled_mm3, 0.01);
  EXPECT_FALSE(started.skives);
  EXPECT_GT(started.drilled_mm3, 3);
}

}  // namespace
}  // namespace osteon
