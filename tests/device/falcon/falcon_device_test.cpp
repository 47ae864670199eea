#include "falcon/falcon_device.h"

#include <gtest/gtest.h>

#include <cmath>

#include "device/falcon/falcon_rig.h"
#include "falcon/falcon_kinematics.h"

namespace osteon {
namespace {

using testing::FalconRig;

TEST(FalconDevice, IsHomedByMovingTheGripAsItsLightTells) {
  FalconRig rig;
  const auto device = rig.open();
  rig.step(5);
  EXPECT_FALSE(device->read().calibrated);
  EXPECT_EQ(device->health().calibration, Calibration::kNeeded);
  EXPECT_NE(std::string(device->health().advice).find("blue"), std::string::npos);
  rig.lead(*device, Vec3(0, 0, -0.03), 50);
  EXPECT_EQ(rig.falcon->command().lights, kFalconRed);
  EXPECT_TRUE(rig.falcon->command().homing);
  EXPECT_FALSE(device->read().calibrated);

  rig.lead(*device, Vec3(0, 0, 0.03), 200);  // past the marks, not yet out
  rig.step(10);
  (void)device->read();
  rig.lead(*device, Vec3(0, 0, 0.03), 20);
  EXPECT_EQ(rig.falcon->homed(), 7);
  EXPECT_EQ(rig.falcon->command().lights, kFalconBlue);
  EXPECT_FALSE(rig.falcon->command().homing);
  EXPECT_FALSE(device->read().calibrated);
  EXPECT_EQ(device->health().calibration, Calibration::kRunning);
  EXPECT_NE(std::string(device->health().advice).find("green"), std::string::npos);

  rig.lead(*device, Vec3(0, 0, 0.048), 100);
  rig.lead(*device, Vec3(0, 0, 0.02), 100);
  EXPECT_TRUE(device->read().calibrated);
  EXPECT_EQ(rig.falcon->command().lights, kFalconGreen);
  EXPECT_EQ(device->health().calibration, Calibration::kDone);
  EXPECT_STREQ(device->health().advice, "");
}

TEST(FalconDevice, GivesNoForceBeforeItIsHomed) {
  FalconRig rig;
  const auto device = rig.open();
  for (int i = 0; i < 50; ++i) {
    rig.step();
    (void)device->read();
    device->write_force(Vec3(3, 3, 3));
    ASSERT_EQ(rig.falcon->command().motors, (std::array<int, 3>{0, 0, 0}));
  }
}

TEST(FalconDevice, TellsWhereTheGripIsToItsResolution) {
  FalconRig rig(HandParams{0.05, 1500, 30});
  const auto device = rig.open();
  rig.home(*device);
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.02, 0, 0), Vec3(0, -0.025, 0.01),
                        Vec3(-0.02, 0.015, -0.02), Vec3(0.01, 0.02, 0.02)}) {
    rig.lead(*device, p, 200);
    rig.lead(*device, p, 100);
    const DeviceSample s = device->read();
    EXPECT_LT((s.X_VD.p - rig.falcon->position_V()).norm(), 2 * falcon::kResolution_m);
    EXPECT_LT(s.v_V.norm(), 0.005);  // at rest
    EXPECT_EQ(s.X_VD.q.coeffs(), Quat::Identity().coeffs());
  }
}

TEST(FalconDevice, TellsItsVelocityInMotion) {
  FalconRig rig(HandParams{0.05, 1500, 30});
  const auto device = rig.open();
  rig.home(*device);
  rig.lead(*device, Vec3(-0.02, 0, 0), 200);
  const Vec3 v(0.1, 0.02, -0.05);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    rig.falcon->want(Vec3(-0.02, 0, 0) + 0.001 * i * v, v);
    rig.step();
    const DeviceSample s = device->read();
    if (i > 100) worst = std::max(worst, (s.v_V - v).norm());
  }
  EXPECT_LT(worst, 0.02);
}

TEST(FalconDevice, PushesTheHandAsOrdered) {
  FalconRig rig;
  const auto device = rig.open();
  rig.home(*device);
  rig.lead(*device, Vec3(0.01, 0.005, 0.01), 200);
  for (const Vec3& force : {Vec3(2, 0, 0), Vec3(0, -2, 0), Vec3(0, 0, 3), Vec3(1, 1, -1)}) {
    for (int i = 0; i < 3; ++i) {
      device->write_force(force);
      rig.step();
      (void)device->read();
    }
    // A count is 0.1 mN m at 60 mm and less: a few mN at the grip.
    EXPECT_LT((rig.falcon->motor_force() - force).norm(), 0.01);
  }
  // More than it may give: to its limit, in the same direction.
  for (int i = 0; i < 3; ++i) {
    device->write_force(Vec3(0, 0, -100));
    rig.step();
    (void)device->read();
  }
  EXPECT_LT(rig.falcon->motor_force().norm(), device->info().peak_force_n + 0.01);
  EXPECT_LT(rig.falcon->motor_force().normalized().z(), -0.999);
  device->write_force(Vec3(NAN, 1, 1));
  rig.step(2);
  EXPECT_EQ(rig.falcon->command().motors, (std::array<int, 3>{0, 0, 0}));
}

TEST(FalconDevice, ACommandThatWaitsBehindAnotherDoesNotStayBehindForEver) {
  FalconRig rig;
  const auto device = rig.open();
  rig.home(*device);
  // One too many in a frame: each later one would wait for its frame's turn.
  device->write_force(Vec3(0, 0, 0.5));
  int late = 0;
  for (int i = 0; i < 200; ++i) {
    const double fz = 1 + 0.01 * (i % 2);
    device->write_force(Vec3(0, 0, fz));
    rig.step();
    (void)device->read();
    if (i > 100 && std::abs(rig.falcon->motor_force().z() - fz) > 0.005) ++late;
  }
  EXPECT_EQ(late, 0);
}

TEST(FalconDevice, TellsItsFourButtons) {
  FalconRig rig;
  const auto device = rig.open();
  rig.home(*device);
  rig.falcon->press(0b1010);
  rig.lead(*device, Vec3(0, 0, 0), 5);
  EXPECT_EQ(device->read().buttons, 0b1010u);
}

TEST(FalconDevice, LastForceWinsWhenTheDeviceStalls) {
  FalconRig rig;
  const auto device = rig.open();
  rig.home(*device);
  rig.bus.faults(rig.port).silent_until_ns = rig.bus.now_ns() + 8'000'000;
  for (int i = 0; i < 8; ++i) {
    device->write_force(Vec3(0, 0, 0.1 * i));
    rig.step();
  }
  for (int i = 0; i < 2; ++i) {
    device->write_force(Vec3(0, 0, 0.7));
    rig.step();
  }
  // What was waiting is gone: only the newest reached the motors.
  EXPECT_NEAR(rig.falcon->motor_force().z(), 0.7, 0.02);
  EXPECT_GT(device->health().replaced, 3u);
}

TEST(FalconDevice, TwoAtOnceFeelEachItsOwnForce) {
  FalconRig rig;
  const auto other = FalconRig::make({});
  other->serial = "FN0002";
  rig.bus.attach(other);
  const auto listed = list_falcons(rig.bus);
  ASSERT_TRUE(listed);
  ASSERT_EQ(listed->size(), 2u);
  const auto left = open_falcon(rig.bus, (*listed)[0]).value();
  const auto right = open_falcon(rig.bus, (*listed)[1]).value();
  EXPECT_EQ(right->info().serial, "FN0002");
  other->home_now();
  other->want(Vec3(0, 0, 0.048));
  rig.home(*left);
  for (int i = 0; i < 300; ++i) {
    rig.step();
    (void)right->read();
    (void)left->read();
  }
  ASSERT_TRUE(left->read().calibrated && right->read().calibrated);
  for (int i = 0; i < 3; ++i) {
    left->write_force(Vec3(1, 0, 0));
    right->write_force(Vec3(0, -1, 0));
    rig.step();
    (void)left->read();
    (void)right->read();
  }
  EXPECT_LT((rig.falcon->motor_force() - Vec3(1, 0, 0)).norm(), 0.01);
  EXPECT_LT((other->motor_force() - Vec3(0, -1, 0)).norm(), 0.01);
}

TEST(FalconDevice, CloseLeavesNoForceAndNoLight) {
  FalconRig rig;
  const auto device = rig.open();
  rig.home(*device);
  for (int i = 0; i < 5; ++i) {
    device->write_force(Vec3(0, 2, 0));
    rig.step();
    (void)device->read();
  }
  EXPECT_GT(rig.falcon->motor_force().norm(), 1.9);
  device->close();
  EXPECT_EQ(rig.falcon->command().motors, (std::array<int, 3>{0, 0, 0}));
  EXPECT_EQ(rig.falcon->command().lights, 0);
  EXPECT_FALSE(device->read().connected);
  device->close();
  // It may be opened again, and keeps its homing while it has power.
  const auto again = rig.open();
  rig.lead(*again, Vec3(0, 0, 0.048), 100);
  EXPECT_TRUE(again->read().calibrated);
}

}  // namespace
}  // namespace osteon
