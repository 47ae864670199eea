// Arms with six driven axes: the stylus' rotations through the library.
#include <gtest/gtest.h>

#include <cmath>

#include "device/phantom/stub_library.h"
#include "phantom/arm_models.h"

namespace osteon {
namespace {

using testing::StubLibrary;

std::unique_ptr<HapticDevice> open_left(StubLibrary& stub, int output_dof = 6) {
  stub.left->model = "PHANTOM Premium 6DOF";
  stub.left->output_dof = output_dof;
  stub.left->max_force_n = 8.5;
  auto opened = PhantomDevice::open(stub.session(), "Left Device");
  EXPECT_TRUE(opened) << opened.error().message();
  stub.step(1);
  return std::move(*opened);
}

Vec3 turned_by_nm(const StubArm& arm) {
  return Vec3(arm.motor_nmm[0], arm.motor_nmm[1], arm.motor_nmm[2]) / 1000;
}

TEST(PhantomTorque, AnArmWithThreeDrivenAxesIsNeverToldOfOne) {
  StubLibrary stub;
  const auto arm = open_left(stub, 3);
  EXPECT_FALSE(arm->info().drives_rotation());
  arm->write({Vec3(1, 0, 0), Vec3(0.1, 0, 0)});
  stub.step(2);
  EXPECT_EQ(turned_by_nm(*stub.left), Vec3::Zero());
  EXPECT_EQ(testing::motor_force(*stub.left), Vec3(1, 0, 0));
  EXPECT_EQ(arm->read().refusal, ForceOff::kNone);
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST(PhantomTorque, ReachesTheMotorsAndNeverMoreThanItsLimit) {
  StubLibrary stub;
  const auto arm = open_left(stub);
  EXPECT_TRUE(arm->info().drives_rotation());
  EXPECT_EQ(arm->info().peak_torque_nm, 0.170);
  EXPECT_EQ(arm->info().continuous_torque_nm, 0.048);
  arm->write({Vec3(1, -2, 0.5), Vec3(0.01, -0.02, 0.03)});
  stub.step(1);
  EXPECT_LT((turned_by_nm(*stub.left) - Vec3(0.01, -0.02, 0.03)).norm(), 1e-15);
  arm->write({Vec3::Zero(), Vec3(0, -30, 40)});
  stub.step(1);
  EXPECT_LT((turned_by_nm(*stub.left) - 0.170 * Vec3(0, -0.6, 0.8)).norm(), 1e-12);
  arm->write({Vec3(1, 0, 0), Vec3(0, std::nan(""), 0)});
  stub.step(1);
  EXPECT_EQ(turned_by_nm(*stub.left), Vec3::Zero());
  EXPECT_EQ(testing::motor_force(*stub.left), Vec3::Zero());
  arm->write_force(Vec3(1, 0, 0));
  stub.step(1);
  EXPECT_EQ(turned_by_nm(*stub.left), Vec3::Zero());
  EXPECT_LE(stub.left->peak_motor_nmm, 170 + 1e-9);
  EXPECT_EQ(stub.misuses(), 0u);
}

// The program stalls with nothing but a torque on the arm.
TEST(PhantomTorque, EndsWithTheServoLoopsWatchdogAndAtAFault) {
  StubLibrary stub;
  const auto arm = open_left(stub);
  arm->write({Vec3::Zero(), Vec3(0.05, 0, 0)});
  stub.step(10);
  EXPECT_GT(turned_by_nm(*stub.left).norm(), 0.04);
  stub.step(15);
  EXPECT_EQ(turned_by_nm(*stub.left), Vec3::Zero());
  EXPECT_EQ(arm->read().refusal, ForceOff::kWatchdog);
  // It stays off until zero of both is ordered.
  for (int i = 0; i < 80; ++i) {
    arm->write({Vec3::Zero(), Vec3(0.05, 0, 0)});
    stub.step(1);
  }
  EXPECT_EQ(turned_by_nm(*stub.left), Vec3::Zero());
  for (int i = 0; i < 5; ++i) {
    arm->write({});
    stub.step(1);
  }
  EXPECT_EQ(arm->read().refusal, ForceOff::kNone);
}

TEST(PhantomModels, SixDrivenAxesHaveLimitsOfTheirOwn) {
  EXPECT_STREQ(arm_model("PHANTOM Premium 1.5 6DOF", 6).profile, "phantom_premium_6dof.toml");
  EXPECT_STREQ(arm_model("PHANTOM Premium 1.5 6DOF", 3).profile, "phantom_premium_1_5.toml");
  EXPECT_STREQ(arm_model("Something new", 6).profile, "phantom_touch.toml");
  DeviceInfo profile;
  profile.torque_axes = {true, true, true};
  profile.peak_torque_nm = 0.17;
  profile.continuous_torque_nm = 0.05;
  ArmReport report;
  report.output_dof = 6;
  report.max_torque_nm = 0.04;
  const DeviceInfo info = limited_by(profile, report);
  EXPECT_EQ(info.peak_torque_nm, 0.04);
  EXPECT_EQ(info.continuous_torque_nm, 0.04);
  report.output_dof = 0;  // an older library does not say
  EXPECT_FALSE(limited_by(profile, report).drives_rotation());
}

}  // namespace
}  // namespace osteon
