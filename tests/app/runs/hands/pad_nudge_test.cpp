#include "runs/hands/pad_nudge.h"

#include <gtest/gtest.h>

#include <limits>

namespace osteon {
namespace {

PadAxes pad_with(const Vec3& move_V, const Vec3& turn_V) {
  PadAxes axes;
  axes.move_V = move_V;
  axes.turn_V = turn_V;
  return axes;
}

TEST(PadNudge, AFullStickForASecond) {
  const RestNudge in = pad_nudge(pad_with(Vec3(0, 1, 0), Vec3::Zero()), 1);
  EXPECT_DOUBLE_EQ(in.in_m, 0.02);
  EXPECT_EQ(in.pitch_rad, 0);
  const RestNudge out = pad_nudge(pad_with(Vec3(0, 0, 1), Vec3::Zero()), 1);
  EXPECT_DOUBLE_EQ(out.in_m, -0.02);
  const RestNudge turned = pad_nudge(pad_with(Vec3::Zero(), Vec3(1, -1, 1)), 0.5);
  EXPECT_DOUBLE_EQ(turned.pitch_rad, 0.45);
  EXPECT_DOUBLE_EQ(turned.yaw_rad, -0.45);
  EXPECT_DOUBLE_EQ(turned.about_rad, 0.45);
}

TEST(PadNudge, StickAndTriggerTogetherAreNoFasterThanOne) {
  EXPECT_DOUBLE_EQ(pad_nudge(pad_with(Vec3(0, 1, -1), Vec3::Zero()), 1).in_m, 0.02);
}

TEST(PadNudge, NothingFromRestFromABrokenStickOrWithoutAGamepad) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(pad_nudge(pad_with(Vec3(1, 0.1, -0.05), Vec3(0.1, 0, 0)), 1).moves());
  EXPECT_FALSE(pad_nudge(pad_with(Vec3(0, kNan, kNan), Vec3(kNan, kNan, kNan)), 1).moves());
  PadAxes gone = pad_with(Vec3(0, 1, 0), Vec3(1, 1, 1));
  EXPECT_FALSE(pad_nudge(gone, 0).moves());
  EXPECT_FALSE(pad_nudge(gone, kNan).moves());
  gone.connected = false;
  EXPECT_FALSE(pad_nudge(gone, 1).moves());
}

TEST(PadNudge, LetGoOfKeepsTheButtons) {
  PadAxes axes = pad_with(Vec3(1, 1, 1), Vec3(1, 1, 1));
  axes.buttons = 1;
  const PadAxes rest = at_rest(axes);
  EXPECT_EQ(rest.move_V, Vec3(Vec3::Zero()));
  EXPECT_EQ(rest.turn_V, Vec3(Vec3::Zero()));
  EXPECT_EQ(rest.buttons, 1u);
}

}  // namespace
}  // namespace osteon
