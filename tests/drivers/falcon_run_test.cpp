#include <gtest/gtest.h>

#include "device/falcon/falcon_rig.h"
#include "drivers/run_loop.h"
#include "falcon/falcon_kinematics.h"

namespace osteon {
namespace {

using testing::FalconRig;
using testing::ForceGap;
using testing::press_and_slide_path;
using testing::RunLoop;

// The path through the whole simulator with a Falcon in the hand: forces at its motors, one a tick.
std::vector<Vec3> felt_by_a_falcon(FalconRig& rig, HapticDevice& device, const ProbePath& path,
                                   double friction, bool passivity) {
  const testing::WantedInV start = testing::wanted_in_V(path, 0);
  rig.home(device);
  rig.lead(device, start.X_VD.p, 300);
  RunLoop loop(test::blocks_case(), device, testing::turned_mapping(), friction, passivity);
  std::vector<Vec3> felt;
  for (double t = 0; t < path.duration_s(); t += 0.001) {
    const testing::WantedInV wanted = testing::wanted_in_V(path, t);
    rig.falcon->want(wanted.X_VD.p, wanted.v_V);
    rig.step();
    if (t > 0) felt.push_back(rig.falcon->motor_force());
    loop.tick();
  }
  EXPECT_EQ(loop.status().cause, ForceOff::kNone) << describe(loop.status().cause);
  return felt;
}

ForceGap run(double friction, bool passivity) {
  FalconRig rig;
  const auto device = rig.open();
  const ProbePath path = press_and_slide_path();
  const auto felt = felt_by_a_falcon(rig, *device, path, friction, passivity);
  const auto wanted = testing::felt_by_the_virtual_hand(path, device->info(), friction, passivity);
  const ForceGap gap = testing::compare(wanted, felt);
  std::printf("Falcon, friction %g: peak %.3f N, rms gap %.4f N, worst %.4f N\n", friction,
              gap.peak_n, gap.rms_n, gap.worst_n);
  EXPECT_GT(gap.peak_n, 1.0);
  return gap;
}

// One step of its encoders through the coupling: its spring, and its damper when the velocity must
// be told from one millisecond to the next.
const double kThroughSpring_n = HapticParams{}.stiffness_n_per_m * falcon::kResolution_m;
const double kThroughDamper_n = HapticParams{}.damping_n_s_per_m * falcon::kResolution_m / 0.001;

TEST(FalconRun, FeelsWhatTheVirtualHandFeelsWithinItsResolution) {
  const ForceGap gap = run(0, false);
  EXPECT_LT(gap.worst_n, kThroughSpring_n + kThroughDamper_n);
  EXPECT_LT(gap.rms_n, 0.5 * kThroughSpring_n);
}

// Where the grip sticks and slips depends on the path before it.
TEST(FalconRun, WithFrictionTooOnTheWhole) {
  const ForceGap gap = run(1, true);
  EXPECT_LT(gap.rms_n, kThroughSpring_n);
  EXPECT_LT(gap.worst_n, 2 * (kThroughSpring_n + kThroughDamper_n));
}

}  // namespace
}  // namespace osteon
