// Faults of a PHANToM arm while its hand leans on a wall: the motors are at zero within the bound,
// the cause is named, and force comes back by the user alone.
#include <gtest/gtest.h>

#include <functional>

#include "device/phantom/stub_library.h"
#include "device/wall_loop.h"

namespace osteon {
namespace {

using testing::motor_force;
using testing::StubLibrary;
using testing::WallLoop;
using testing::want;

const Vec3 kFaultCentre_mm(0, 50, -30);

class PhantomFault : public ::testing::Test {
 protected:
  PhantomFault() {
    want(*stub.left, kFaultCentre_mm - Vec3(5, 0, 0));
    device = PhantomDevice::open(session, "Left Device").value();
    loop = std::make_unique<WallLoop>(*device);
    run(20);
    loop->gate.enable();
    run(600);  // the ramp
    want(*stub.left, kFaultCentre_mm + Vec3(6, 0, 0));
    run(400);
    EXPECT_LT(motor_force(*stub.left).x(), -1.0) << "no contact to begin with";
    EXPECT_EQ(loop->gate.cause(), ForceOff::kNone);
  }

  void run(int ms) {
    for (int i = 0; i < ms; ++i) {
      stub.step(1);
      loop->tick();
    }
  }

  // Runs until the motors rest; how many ms that took.
  int ms_to_zero() {
    for (int ms = 1; ms <= 1000; ++ms) {
      run(1);
      if (motor_force(*stub.left).isZero(0)) return ms;
    }
    return 1000;
  }

  // The motors are and stay at zero however long one waits, and whatever heals.
  void expect_off(ForceOff cause) {
    EXPECT_EQ(loop->gate.cause(), cause) << describe(loop->gate.cause());
    for (int i = 0; i < 1500; ++i) {
      run(1);
      ASSERT_TRUE(motor_force(*stub.left).isZero(0)) << i;
    }
    EXPECT_EQ(loop->gate.cause(), cause);
  }

  void expect_force_after_enable() {
    loop->gate.enable();
    run(5);
    EXPECT_LT(motor_force(*stub.left).norm(), 0.5) << "no ramp";
    run(1500);
    EXPECT_LT(motor_force(*stub.left).x(), -1.0);
  }

  StubLibrary stub;
  std::shared_ptr<HdSession> session = stub.session();
  std::unique_ptr<HapticDevice> device;
  std::unique_ptr<WallLoop> loop;
};

TEST_F(PhantomFault, UnpluggedAndPluggedInAgain) {
  stub.left->plugged = false;
  EXPECT_LE(ms_to_zero(), 1);
  run(1);
  expect_off(ForceOff::kDisconnect);
  EXPECT_NE(std::string(device->health().advice).find("cable"), std::string::npos);
  stub.left->plugged = true;
  expect_off(ForceOff::kDisconnect);
  EXPECT_FALSE(device->read().connected) << "an arm that comes back must be opened anew";

  // The user opens it again and switches the force on.
  loop.reset();
  device.reset();
  device = PhantomDevice::open(session, "Left Device").value();
  loop = std::make_unique<WallLoop>(*device);
  run(20);
  EXPECT_TRUE(motor_force(*stub.left).isZero(0));
  expect_force_after_enable();
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST_F(PhantomFault, AShortStallOfTheProgramIsNoFault) {
  const double before = motor_force(*stub.left).x();
  stub.step(5);
  run(1);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone);
  EXPECT_NEAR(motor_force(*stub.left).x(), before, 0.2);
}

TEST_F(PhantomFault, AStallOfTheProgramOf20msEndsInZeroAtItsBound) {
  stub.step(20);
  EXPECT_FALSE(motor_force(*stub.left).isZero(0)) << "20 ms are borne";
  stub.step(1);
  EXPECT_TRUE(motor_force(*stub.left).isZero(0));
  run(1);
  expect_off(ForceOff::kWatchdog);
  expect_force_after_enable();
}

TEST_F(PhantomFault, AStallOfTheProgramOf100ms) {
  stub.step(100);
  EXPECT_TRUE(motor_force(*stub.left).isZero(0));
  run(1);
  EXPECT_TRUE(motor_force(*stub.left).isZero(0));
  expect_off(ForceOff::kWatchdog);
  expect_force_after_enable();
}

TEST_F(PhantomFault, TheLibrarysOwnLoopIsLate) {
  // The motors hold what the late loop told them; the first pass that comes tells them zero.
  for (const int ms : {5, 30}) {
    for (int i = 0; i < ms; ++i) {
      stub.stall(1);
      loop->tick();
    }
    if (ms == 5) {
      run(20);
      EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << "5 ms are borne";
      EXPECT_LT(motor_force(*stub.left).x(), -1.0);
    }
  }
  EXPECT_LE(ms_to_zero(), 1);
  expect_off(ForceOff::kDisconnect);
  expect_force_after_enable();
}

TEST_F(PhantomFault, APauseWithoutForceIsNoFault) {
  want(*stub.left, kFaultCentre_mm - Vec3(5, 0, 0));
  run(300);
  stub.step(500);  // nobody orders anything for half a second
  run(1);
  EXPECT_EQ(device->read().refusal, ForceOff::kNone);
}

TEST_F(PhantomFault, ReadingsThatMakeNoSense) {
  for (const int garbage : {1, 2, 3}) {
    const std::uint64_t bad_before = device->health().bad_reports;
    stub.left->garbage = garbage;
    EXPECT_LE(ms_to_zero(), 11) << garbage;
    run(1);
    EXPECT_EQ(loop->gate.cause(), ForceOff::kDeviceFault);
    EXPECT_GT(device->health().bad_reports, bad_before + 5);
    EXPECT_TRUE(is_finite(device->read().X_VD));
    stub.left->garbage = 0;
    expect_off(ForceOff::kDeviceFault);
    expect_force_after_enable();
  }
}

TEST_F(PhantomFault, OneBadReadingIsPassedOver) {
  stub.left->garbage = 2;
  run(3);
  stub.left->garbage = 0;
  run(20);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone);
  EXPECT_LT(motor_force(*stub.left).x(), -1.0);
}

TEST_F(PhantomFault, OneBadReadingAfterALateLoopIsPassedOverToo) {
  for (int i = 0; i < 12; ++i) {
    stub.stall(1);
    loop->tick();
  }
  stub.left->garbage = 2;
  run(1);
  stub.left->garbage = 0;
  run(700);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << describe(loop->gate.cause());
  EXPECT_LT(motor_force(*stub.left).x(), -1.0);
}

TEST_F(PhantomFault, NotANumberFromAbove) {
  loop->add_nan = true;
  EXPECT_LE(ms_to_zero(), 2);
  loop->add_nan = false;
  expect_off(ForceOff::kNotFinite);
  expect_force_after_enable();
}

TEST_F(PhantomFault, TooFast) {
  stub.left->speed = 1500;  // as the library tells it: the gate sees that by itself
  EXPECT_LE(ms_to_zero(), 2);
  stub.left->speed = 0;
  expect_off(ForceOff::kVelocity);
  expect_force_after_enable();
}

TEST_F(PhantomFault, ErrorsThatTheLibraryReports) {
  const std::pair<hd::ErrorCode, ForceOff> faults[] = {
      {hd::kExceededMaxVelocity, ForceOff::kVelocity},
      {hd::kWarmMotors, ForceOff::kTemperature},
      {hd::kExceededMaxForce, ForceOff::kDeviceFault},
      {hd::kExceededMaxForceImpulse, ForceOff::kDeviceFault},
      {hd::kForceError, ForceOff::kDeviceFault},
      {hd::kDeviceFault, ForceOff::kDeviceFault},
  };
  for (const auto& [code, cause] : faults) {
    stub.left->raise = code;
    EXPECT_LE(ms_to_zero(), 1) << std::hex << code;
    run(1);
    expect_off(cause);
    expect_force_after_enable();
  }
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST_F(PhantomFault, WarmMotors) {
  stub.left->temperature = 0.7;
  run(20);
  EXPECT_NEAR(device->health().motor_heat, 0.7, 1e-12);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone);
  stub.left->temperature = 1.02;
  EXPECT_LE(ms_to_zero(), 11);
  run(1);
  expect_off(ForceOff::kTemperature);
  EXPECT_NE(std::string(device->health().advice).find("warm"), std::string::npos);
  // Still too warm to begin again: the wish is refused with the same cause.
  stub.left->temperature = 0.9;
  loop->gate.enable();
  run(100);
  expect_off(ForceOff::kTemperature);
  stub.left->temperature = 0.5;
  run(100);
  expect_force_after_enable();
}

TEST_F(PhantomFault, LostCalibration) {
  stub.left->calibration = hd::kCalibrationNeedsManualInput;
  EXPECT_LE(ms_to_zero(), 11);
  run(1);
  expect_off(ForceOff::kCalibration);
  EXPECT_STREQ(device->health().advice, "Put the stylus into the inkwell");
  stub.left->calibration = hd::kCalibrationOk;
  expect_off(ForceOff::kCalibration);
  expect_force_after_enable();
}

TEST_F(PhantomFault, TheHandLetsGoOfTheStylus) {
  stub.left->switch_held = false;
  EXPECT_LE(ms_to_zero(), 1);
  run(1);
  stub.left->switch_held = true;
  expect_off(ForceOff::kDeadMan);
  expect_force_after_enable();
}

TEST_F(PhantomFault, ExitInContact) {
  const std::uint64_t frames = stub.left->frames;
  device->close();
  EXPECT_TRUE(motor_force(*stub.left).isZero(0));
  EXPECT_GT(stub.left->frames, frames) << "zero was not sent before the arm was released";
  EXPECT_FALSE(stub.left->open);
  EXPECT_FALSE(stub.scheduler_runs());
  device->close();
  EXPECT_EQ(stub.left->disables, 1u);
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST_F(PhantomFault, TheProgramVanishesWithoutClosing) {
  // No tick any more, ever; only the library's own loop lives.
  stub.step(21);
  EXPECT_TRUE(motor_force(*stub.left).isZero(0));
}

TEST_F(PhantomFault, AFaultOfOneArmLeavesTheOtherAlone) {
  const auto right = PhantomDevice::open(session, "Right Device").value();
  for (int i = 0; i < 50; ++i) {
    stub.step(1);
    loop->tick();
    right->write_force(Vec3(0, 1, 0));
  }
  stub.left->plugged = false;
  for (int i = 0; i < 50; ++i) {
    stub.step(1);
    loop->tick();
    right->write_force(Vec3(0, 1, 0));
  }
  EXPECT_TRUE(motor_force(*stub.left).isZero(0));
  EXPECT_EQ(motor_force(*stub.right), Vec3(0, 1, 0));
  EXPECT_TRUE(right->read().connected);
  EXPECT_EQ(right->read().refusal, ForceOff::kNone);
}

}  // namespace
}  // namespace osteon
