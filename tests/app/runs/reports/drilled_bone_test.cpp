#include "runs/reports/drilled_bone.h"

#include <gtest/gtest.h>

#include "../../../carve/carve_fixtures.h"
#include "osteon/carve/carved_surface.h"

namespace osteon {
namespace {

// A block of 30 mm that is drilled along x, straight or aslant.
class DrilledBone : public ::testing::Test {
 protected:
  DrilledBone()
      : whole_(test::box_mesh(Vec3::Constant(0.015))),
        field_(test::value(CarvedField::make(test::block_field(0.015, 0.0005), {}, 8192))) {}

  void drill(double size_mm, const Vec3& from, const Vec3& to) {
    const Vec3 up = (from - to).normalized();
    Vec3 at = from;
    for (int step = 1; step <= 20; ++step) {
      const Vec3 next = from + step / 20.0 * (to - from);
      const CarveStep cut = field_.cut(test::cutter("drill", size_mm), test::pose_along(at, up),
                                       test::pose_along(next, up));
      EXPECT_EQ(cut.status & (CarveStep::kBlocksFull | CarveStep::kTooLong), 0u);
      at = next;
    }
  }
  std::optional<DrilledHole> found() { return find_drilled(field_, whole_, whole_); }

  MeshDistance whole_;
  CarvedField field_;
};

TEST_F(DrilledBone, ABoneThatNobodyDrilledHasNoHole) { EXPECT_FALSE(found()); }

TEST_F(DrilledBone, AHoleThatIsTooNarrowForAGraftIsNone) {
  drill(3, {0.025, 0, 0}, {-0.025, 0, 0});
  EXPECT_FALSE(found());
}

TEST_F(DrilledBone, ATunnelIsThroughAndItsLineRunsOutOnBothSides) {
  drill(8, {0.025, 0.002, 0}, {-0.025, 0.002, 0});
  const auto hole = found();
  ASSERT_TRUE(hole);
  EXPECT_TRUE(hole->through);
  EXPECT_TRUE(hole->line.open);
  EXPECT_EQ(hole->channel_m, 0);
  EXPECT_NEAR(hole->line.diameter_m, 0.008, 0.0002);
  EXPECT_NEAR(hole->length_m, 0.030, 0.0005);
  EXPECT_NEAR((hole->line.to_W - hole->line.from_W).norm(), 0.034, 0.0005);
  EXPECT_NEAR(hole->line.from_W.y(), 0.002, 0.0002);
}

TEST_F(DrilledBone, ASocketEndsInTheBoneAndItsChannelGoesOn) {
  drill(8, {0.025, 0, 0}, {-0.001, 0, 0});
  const auto blind = found();
  ASSERT_TRUE(blind);
  EXPECT_FALSE(blind->through);
  EXPECT_FALSE(blind->line.open);
  EXPECT_EQ(blind->channel_m, 0);
  EXPECT_NEAR(blind->length_m, 0.0145, 0.003);
  drill(4.5, {0.025, 0, 0}, {-0.025, 0, 0});
  const auto socket = found();
  ASSERT_TRUE(socket);
  EXPECT_FALSE(socket->through);
  EXPECT_NEAR(socket->line.diameter_m, 0.008, 0.0002);
  EXPECT_NEAR(socket->channel_m, 0.0045, 0.0002);
}

TEST_F(DrilledBone, ANarrowHoleBesideASocketIsNotItsChannel) {
  drill(8, {0.025, 0.005, 0}, {-0.001, 0.005, 0});
  drill(4.5, {0.025, -0.008, 0}, {-0.025, -0.008, 0});
  const auto hole = found();
  ASSERT_TRUE(hole);
  EXPECT_NEAR(hole->line.diameter_m, 0.008, 0.0002);
  EXPECT_EQ(hole->channel_m, 0);
}

// A reamer of 8 mm that was pushed aside: a channel of 4.5 mm lies in its bottom up to 1.75 mm off.
TEST_F(DrilledBone, AChannelAsideGoesOnWhileItLiesInTheSocketsBottom) {
  drill(8, {0.025, 0.0014, 0}, {-0.001, 0.0014, 0});
  drill(4.5, {0.025, 0, 0}, {-0.025, 0, 0});
  const auto inside = found();
  ASSERT_TRUE(inside);
  EXPECT_NEAR(inside->line.diameter_m, 0.008, 0.0002);
  EXPECT_NEAR(inside->channel_m, 0.0045, 0.0002);
}

TEST_F(DrilledBone, AChannelThatCutsTheSocketsWallIsNone) {
  drill(8, {0.025, 0.0025, 0}, {-0.001, 0.0025, 0});
  drill(4.5, {0.025, 0, 0}, {-0.025, 0, 0});
  const auto hole = found();
  ASSERT_TRUE(hole);
  EXPECT_EQ(hole->channel_m, 0);
}

TEST_F(DrilledBone, OfTwoHolesTheOneThatHoldsMoreCounts) {
  drill(5, {0.025, -0.008, 0}, {-0.025, -0.008, 0});
  drill(9, {0.025, 0.006, 0}, {-0.025, 0.006, 0});
  const auto hole = found();
  ASSERT_TRUE(hole);
  EXPECT_NEAR(hole->line.diameter_m, 0.009, 0.0002);
}

// The wider one was there already: the bone before has it.
TEST_F(DrilledBone, AHoleThatWasThereBeforeDoesNotCount) {
  drill(9, {0.025, 0.006, 0}, {-0.025, 0.006, 0});
  CarvedSurface surface(field_);
  surface.update(field_);
  const MeshDistance before(surface.joined());
  EXPECT_FALSE(find_drilled(field_, whole_, before));
  drill(8, {0.025, -0.007, 0}, {-0.025, -0.007, 0});
  const auto hole = find_drilled(field_, whole_, before);
  ASSERT_TRUE(hole);
  EXPECT_NEAR(hole->line.diameter_m, 0.008, 0.0002);
  EXPECT_NEAR(hole->line.from_W.y(), -0.007, 0.0002);
}

TEST_F(DrilledBone, TheHolesOfAMeshComeWithTheOneThatHoldsMostFirst) {
  EXPECT_TRUE(holes_of(whole_.mesh()).empty());
  drill(5, {0.025, -0.008, 0}, {-0.025, -0.008, 0});
  drill(9, {0.025, 0.006, 0}, {-0.001, 0.006, 0});
  CarvedSurface surface(field_);
  surface.update(field_);
  const auto holes = holes_of(surface.joined());
  ASSERT_EQ(holes.size(), 2u);
  EXPECT_NEAR(holes[0].diameter_m, 0.009, 0.0002);
  EXPECT_NEAR(holes[1].diameter_m, 0.005, 0.0002);
  EXPECT_FALSE(holes[0].open);
  EXPECT_TRUE(holes[1].open);
}

}  // namespace
}  // namespace osteon
