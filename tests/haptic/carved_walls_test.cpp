// A drill over a narrower hole, through the whole tick. The holes are cylinders in closed form; the
// place where a ball rests on a round rim is known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "collide/stepped_hole.h"
#include "field_walls.h"
#include "mesh/shapes.h"
#include "test_scene.h"

namespace osteon {
namespace {

constexpr double kSpring = 2000;  // of plain_params
constexpr double kHalf = 0.008;   // of the block
constexpr test::SteppedHole kHole;
constexpr double kFelt = 0.00215;  // radius of the drill

// The drill's tip stands at the tool's origin, its shaft along +z.
Tool drill() {
  Tool tool;
  tool.name = "drill";
  tool.parts = {make_rod(Vec3(0, 0, kFelt), Vec3(0, 0, 0.05), kFelt)};
  return tool;
}

// Height of the tip where the ball lies on the rim of the narrow hole.
const double kRests =
    kHole.step_m + std::sqrt(kFelt * kFelt - kHole.narrow_m * kHole.narrow_m) - kFelt;

struct DrillOverHole {
  CutField cuts = kHole.cuts();
  test::Rig rig{{test::field_bone(test::cube(kHalf))}, drill()};

  DrillOverHole() {
    const CutField* one[] = {&cuts};
    rig.loop.set_cuts(one);
    rig.at(Vec3(0, 0, 0.02));
  }
};

// Splines over cells of 0.4 mm round the edge of a rim by about half a cell.
constexpr double kRound = 0.00025;

class OverAHole : public ::testing::TestWithParam<Vec3> {};

TEST_P(OverAHole, TheRimHoldsTheDrillAndItsForceIsFeltWithoutAJump) {
  DrillOverHole scene;
  const Vec3 top = Vec3(0, 0, 0.012) + GetParam(), bottom = Vec3(0, 0, 0.0015) + GetParam();
  double last = 0;
  for (int i = 0; i <= 1000; ++i) {
    const Vec3 hand = top + (bottom - top) * (i / 1000.0);
    const ToolState& s = scene.rig.at(hand);
    ASSERT_GT(s.X_WP.p.z(), kRests - kRound) << i;
    if (hand.z() < kRests - kRound) {
      EXPECT_NEAR(s.force_W.z(), kSpring * (s.X_WP.p.z() - hand.z()), 0.05) << i;
      EXPECT_GT(s.contact_count, 0U) << i;
    }
    EXPECT_LT(std::abs(s.force_W.z() - last), 0.1) << "jumps at " << i;
    last = s.force_W.z();
  }
  const ToolState& s = scene.rig.at(bottom);
  EXPECT_LT(s.X_WP.p.z(), kRests + kRound);
  EXPECT_GT(last, kSpring * (kRests - kRound - bottom.z()));
  EXPECT_TRUE(test::go(scene.rig, bottom, top, 500).force_W.isZero(0));
}

INSTANTIATE_TEST_SUITE_P(Beside, OverAHole,
                         ::testing::Values(Vec3(0, 0, 0), Vec3(5e-5, 0, 0), Vec3(0, -8e-5, 0),
                                           Vec3(3e-5, 6e-5, 0)));

// A tick that has looked as often as it may goes on a little all the same: otherwise the next one,
// which begins as it did, would stand still as well, however far the bone is cut away.
TEST(CarvedWalls, WhereNoLooksAreLeftTheProxyStillComesNearer) {
  const CutField cuts = kHole.cuts();
  const CutField* one[] = {&cuts};
  Case the_case;
  the_case.bones.push_back(test::field_bone(test::cube(kHalf)));
  const Tool tool = drill();
  ContactField field(the_case, tool);
  field.set_cuts(one);
  FieldWalls walls(field);
  CandidateList near;
  near.field_count = 1;
  walls.start(near);
  const std::array<Pose, 1> X_WB;
  // Over the face, nearer than a stride is long.
  const Vec3 from(0.005, 0.005, kHalf + 1e-5);
  const Vec3 into = from - Vec3(0, 0, 0.0005);
  while (!walls.spent()) ASSERT_TRUE(walls.look(X_WB, {from, Quat::Identity()}));
  const Vec3 there = walls.way(X_WB, Quat::Identity(), from, into);
  EXPECT_LT(there.z(), from.z() - 1e-6);
  EXPECT_GE(there.z(), kHalf);
  EXPECT_TRUE(walls.is_blocked());
}

}  // namespace
}  // namespace osteon
