#include "haptic_command.h"

#include <gtest/gtest.h>

#include <limits>

namespace osteon {
namespace {

bool same(const HapticParams& a, const HapticParams& b) {
  return a.stiffness_n_per_m == b.stiffness_n_per_m && a.friction_scale == b.friction_scale &&
         a.force_on == b.force_on && a.grab_n_per_m == b.grab_n_per_m &&
         a.max_force_n == b.max_force_n;
}

TEST(HapticCommand, SetsWhatItNames) {
  HapticParams params;
  apply_command({CommandKind::kSetStiffness, 1500}, params);
  apply_command({CommandKind::kSetFrictionScale, 0.25}, params);
  EXPECT_EQ(params.stiffness_n_per_m, 1500);
  EXPECT_EQ(params.friction_scale, 0.25);
  apply_command({CommandKind::kForceOff, 1}, params);
  EXPECT_FALSE(params.force_on);
  apply_command({CommandKind::kForceOff, 0}, params);
  EXPECT_TRUE(params.force_on);
  apply_command({CommandKind::kGrab, 150}, params);
  EXPECT_EQ(params.grab_n_per_m, 150);
  apply_command({CommandKind::kGrab, 0}, params);
  EXPECT_EQ(params.grab_n_per_m, 0);
}

TEST(HapticCommand, RefusesValuesOutOfRange) {
  const double bad[] = {-1, 1e9, std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity()};
  for (const CommandKind kind : {CommandKind::kSetStiffness, CommandKind::kSetFrictionScale,
                                 CommandKind::kForceOff, CommandKind::kGrab}) {
    for (const double value : bad) {
      HapticParams params;
      apply_command({kind, value}, params);
      EXPECT_TRUE(same(params, HapticParams{}));
    }
  }
}

TEST(HapticCommand, LeavesAloneWhatIsNotForIt) {
  HapticParams params;
  apply_command({CommandKind::kNone, 1}, params);
  apply_command({CommandKind::kHoldBones, 1}, params);
  apply_command({static_cast<CommandKind>(77), 1}, params);
  EXPECT_TRUE(same(params, HapticParams{}));
}

}  // namespace
}  // namespace osteon
