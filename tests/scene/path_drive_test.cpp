#include "osteon/scene/path_drive.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

PathSample driven(double power, double jaw) {
  PathSample sample;
  sample.power = power;
  sample.jaw = jaw;
  return sample;
}

TEST(PathDrive, SaysNothingWhereNothingChanges) {
  PathDrive drive;
  EXPECT_EQ(drive.next(driven(0, 0)).kind, CommandKind::kNone);
}

TEST(PathDrive, PowerComesFirstAndTheJawsInTheNextTick) {
  PathDrive drive;
  const Command power = drive.next(driven(0.5, 1)), jaw = drive.next(driven(0.5, 1));
  EXPECT_EQ(power.kind, CommandKind::kPower);
  EXPECT_EQ(power.value, 0.5);
  EXPECT_EQ(jaw.kind, CommandKind::kJaw);
  EXPECT_EQ(jaw.value, 1);
  EXPECT_EQ(drive.next(driven(0.5, 1)).kind, CommandKind::kNone);
}

TEST(PathDrive, WhatIsTakenIsDrivenAnew) {
  PathDrive drive;
  (void)drive.next(driven(1, 0));
  drive.took();
  EXPECT_EQ(drive.next(driven(1, 0)).kind, CommandKind::kPower);
}

}  // namespace
}  // namespace osteon
