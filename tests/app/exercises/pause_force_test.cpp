#include "exercises/pause_force.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(PauseForce, IsOffInAPauseWhateverItWas) {
  for (const bool wanted : {false, true})
    for (const ForceOff cause : {ForceOff::kNone, ForceOff::kSoftware, ForceOff::kDeviceFault})
      EXPECT_EQ(force_at_pause(true, wanted, cause), std::optional(false));
}

TEST(PauseForce, ComesBackOnlyWhereThePauseItselfTookItOff) {
  EXPECT_EQ(force_at_pause(false, true, ForceOff::kSoftware), std::optional(true));
  // Off before the pause, or taken off by the user meanwhile: ExerciseControl::forget_force.
  EXPECT_EQ(force_at_pause(false, false, ForceOff::kSoftware), std::nullopt);
  // A fault or the device's own switch took it off: that is theirs to end.
  for (const ForceOff cause :
       {ForceOff::kNone, ForceOff::kButton, ForceOff::kVelocity, ForceOff::kWatchdog,
        ForceOff::kDisconnect, ForceOff::kDeadMan, ForceOff::kDeviceFault})
    EXPECT_EQ(force_at_pause(false, true, cause), std::nullopt);
}

}  // namespace
}  // namespace osteon
