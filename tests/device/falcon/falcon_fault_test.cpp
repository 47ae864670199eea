// Faults of a Falcon while its hand leans on a wall. The emulated firmware keeps its motors at what
// they were last told, so that only the driver's own zero ends the force.
#include <gtest/gtest.h>

#include "device/falcon/falcon_rig.h"
#include "device/wall_loop.h"

namespace osteon {
namespace {

using testing::FalconRig;
using testing::WallLoop;

class FalconFault : public ::testing::Test {
 protected:
  FalconFault() {
    rig.home(*device);
    rig.lead(*device, Vec3(-0.005, 0, 0), 200);
    loop = std::make_unique<WallLoop>(*device);
    run(20);
    loop->gate.enable();
    run(600);
    rig.falcon->want(Vec3(0.006, 0, 0));
    run(400);
    EXPECT_LT(rig.falcon->motor_force().x(), -1.0) << "no contact to begin with";
    EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << describe(loop->gate.cause());
  }

  void run(int ms) {
    for (int i = 0; i < ms; ++i) {
      rig.step();
      loop->tick();
    }
  }
  bool at_rest() const { return rig.falcon->command().motors == std::array<int, 3>{0, 0, 0}; }

  int ms_to_zero() {
    for (int ms = 1; ms <= 1000; ++ms) {
      run(1);
      if (at_rest()) return ms;
    }
    return 1000;
  }

  void expect_off(ForceOff cause) {
    EXPECT_EQ(loop->gate.cause(), cause) << describe(loop->gate.cause());
    for (int i = 0; i < 1500; ++i) {
      run(1);
      ASSERT_TRUE(at_rest()) << i;
    }
    EXPECT_EQ(loop->gate.cause(), cause);
  }

  void expect_force_after_enable() {
    loop->gate.enable();
    run(5);
    EXPECT_LT(rig.falcon->motor_force().norm(), 0.5) << "no ramp";
    run(1500);
    EXPECT_LT(rig.falcon->motor_force().x(), -1.0);
  }

  UsbFaults& faults() { return rig.bus.faults(rig.port); }
  void be_silent_for(int ms) { faults().silent_until_ns = rig.bus.now_ns() + ms * 1'000'000ll; }

  FalconRig rig;
  std::unique_ptr<HapticDevice> device = rig.open();
  std::unique_ptr<WallLoop> loop;
};

TEST_F(FalconFault, UnpluggedAndPluggedInAgain) {
  rig.bus.detach(rig.port);
  run(2);
  EXPECT_TRUE(at_rest());
  EXPECT_FALSE(loop->sample.connected);
  expect_off(ForceOff::kDisconnect);
  EXPECT_NE(std::string(device->health().advice).find("unplugged"), std::string::npos);

  rig.port = rig.bus.attach(rig.falcon);
  expect_off(ForceOff::kDisconnect);
  loop.reset();
  device.reset();
  device = rig.open();
  loop = std::make_unique<WallLoop>(*device);
  run(20);
  EXPECT_FALSE(loop->sample.calibrated) << "it must be seen to be homed again";
  rig.lead(*device, Vec3(0, 0, 0.048), 200);
  rig.lead(*device, Vec3(0.006, 0, 0), 300);
  run(100);
  EXPECT_TRUE(at_rest());
  expect_force_after_enable();
}

TEST_F(FalconFault, SilentFor5ms) {
  be_silent_for(5);
  run(40);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << describe(loop->gate.cause());
  EXPECT_LT(rig.falcon->motor_force().x(), -1.0);
}

TEST_F(FalconFault, SilentFor20ms) {
  be_silent_for(20);
  // Nothing can reach it before it listens again; the first that does is zero.
  run(20);
  EXPECT_LE(ms_to_zero(), 3);
  expect_off(ForceOff::kDisconnect);
  expect_force_after_enable();
}

TEST_F(FalconFault, SilentFor100ms) {
  be_silent_for(100);
  run(100);
  EXPECT_LE(ms_to_zero(), 3);
  expect_off(ForceOff::kDisconnect);
  expect_force_after_enable();
}

TEST_F(FalconFault, AStallOfTheProgram) {
  rig.step(5);
  run(20);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << "5 ms are borne";
  for (const int ms : {25, 100}) {
    rig.step(ms);
    EXPECT_LE(ms_to_zero(), 2) << ms;
    expect_off(ForceOff::kWatchdog);
    expect_force_after_enable();
  }
}

TEST_F(FalconFault, GarbageOnTheWire) {
  faults().garbage_in = 3;
  run(30);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << "3 bad packets are borne";
  EXPECT_GE(device->health().bad_reports + 3, 3u);
  faults().garbage_in = 40;
  EXPECT_LE(ms_to_zero(), 14);
  run(60);
  expect_off(ForceOff::kDisconnect);
  expect_force_after_enable();
}

TEST_F(FalconFault, ReadingsThatBelongToNoPosition) {
  const std::uint64_t before = device->health().bad_reports;
  rig.falcon->nonsense = true;
  EXPECT_LE(ms_to_zero(), 14);
  EXPECT_GT(device->health().bad_reports, before + 5);
  EXPECT_TRUE(is_finite(loop->sample.X_VD));
  rig.falcon->nonsense = false;
  expect_off(ForceOff::kDeviceFault);
  expect_force_after_enable();
}

TEST_F(FalconFault, ShortPackets) {
  faults().short_in = 2;
  run(30);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << "2 short packets are borne";
  faults().short_in = 40;
  EXPECT_LE(ms_to_zero(), 14);
  run(60);
  expect_off(ForceOff::kDisconnect);
  expect_force_after_enable();

  faults().short_out = 1;  // half a command reached it
  EXPECT_LE(ms_to_zero(), 4);
  expect_off(ForceOff::kDeviceFault);
  expect_force_after_enable();
}

TEST_F(FalconFault, LatePackets) {
  faults().in_late_ns = 15'000'000;
  EXPECT_LE(ms_to_zero(), 14);
  faults().in_late_ns = 0;
  run(60);
  expect_off(ForceOff::kDisconnect);
  expect_force_after_enable();
}

TEST_F(FalconFault, Stall) {
  faults().stall_in = true;
  EXPECT_LE(ms_to_zero(), 3);
  expect_off(ForceOff::kDeviceFault);
  expect_force_after_enable();
  faults().stall_out = true;
  EXPECT_LE(ms_to_zero(), 4);
  expect_off(ForceOff::kDeviceFault);
  EXPECT_NE(std::string(device->health().advice), "motors");
  expect_force_after_enable();
}

TEST_F(FalconFault, NotANumberFromAbove) {
  loop->add_nan = true;
  EXPECT_LE(ms_to_zero(), 2);
  loop->add_nan = false;
  expect_off(ForceOff::kNotFinite);
  expect_force_after_enable();
}

TEST_F(FalconFault, TooFast) {
  rig.falcon->want(Vec3(0.006, 0, 0), Vec3(0, 40, 0));  // torn aside
  EXPECT_LE(ms_to_zero(), 40);
  rig.falcon->want(Vec3(0.006, 0, 0));
  EXPECT_EQ(loop->gate.cause(), ForceOff::kVelocity) << describe(loop->gate.cause());
  expect_off(ForceOff::kVelocity);
  expect_force_after_enable();
}

TEST_F(FalconFault, LostHoming) {
  rig.falcon->lose_homing();
  EXPECT_LE(ms_to_zero(), 3);
  expect_off(ForceOff::kCalibration);
  EXPECT_EQ(device->health().calibration, Calibration::kNeeded);
  EXPECT_EQ(rig.falcon->command().lights, kFalconRed);
  rig.home(*device);
  rig.lead(*device, Vec3(0.006, 0, 0), 200);
  expect_off(ForceOff::kCalibration);
  expect_force_after_enable();
}

TEST_F(FalconFault, PowerLost) {
  rig.falcon->switch_off_and_on();  // its firmware is gone
  run(15);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kDisconnect);
  EXPECT_TRUE(at_rest());
  // Opened anew it gets its firmware again, and must be homed again.
  loop.reset();
  device.reset();
  device = rig.open();
  EXPECT_TRUE(rig.falcon->runs());
  rig.step(5);
  EXPECT_FALSE(device->read().calibrated);
  rig.home(*device);
  EXPECT_TRUE(device->read().calibrated);
}

TEST_F(FalconFault, ExitInContact) {
  device->close();
  EXPECT_TRUE(at_rest());
  EXPECT_EQ(rig.falcon->command().lights, 0);
}

TEST_F(FalconFault, ExitWhileTheDeviceIsDeafWaitsNoLongerThanASecond) {
  be_silent_for(10'000);
  const std::int64_t before = rig.bus.now_ns();
  device->close();
  EXPECT_LT(rig.bus.now_ns() - before, 1'000'000'000);
}

}  // namespace
}  // namespace osteon
