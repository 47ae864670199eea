// What goes wrong in contact, in both dialects, with the safety gate between: each ends with zero
// force at the motors within its bound, the cause named, and no force again but by the user.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "device/joystick/joystick_rig.h"
#include "joystick/vector_report.h"

namespace osteon {
namespace {

using testing::JoystickRig;
using testing::kMs;
using testing::WallLoop;

constexpr int kFirmwareTimeout_ms = 20;
// A zero that we send is at the motors so long after the tick that knew: one frame for each report
// that may be ahead of it (PID: an axis a frame).
constexpr int kZeroByReport_ms = 5;

class JoystickFault : public ::testing::TestWithParam<testing::JoystickKind> {
 protected:
  // Presses 3 mm into a wall at x = 0 with the force on and past its ramp.
  void SetUp() override {
    rig.want(Vec3(-0.005, 0, 0));
    rig.open();
    loop = std::make_unique<WallLoop>(*rig.device);
    run(20);
    loop->gate.enable();
    run(700);
    rig.want(Vec3(0.010, 0, 0));
    run(300);
    ASSERT_EQ(loop->gate.cause(), ForceOff::kNone) << describe(loop->gate.cause());
    ASSERT_LT(rig.motors().x(), -1.0);
  }

  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      rig.pass_ms(1);
      loop->tick();
    }
  }

  // Ticks on; how long until the motors are at zero and stay there for `hold` ticks.
  int ms_to_zero(int limit, int hold = 100) {
    int zero_since = -1;
    for (int i = 1; i <= limit; ++i) {
      run(1);
      if (rig.motors() != Vec3(Vec3::Zero()))
        zero_since = -1;
      else if (zero_since < 0)
        zero_since = i;
      if (zero_since > 0 && i - zero_since >= hold) return zero_since;
    }
    return limit + 1;
  }

  // Nothing but the user's own wish brings the force back, and that does.
  void expect_rearm_by_the_user_only(bool to_contact = true) {
    run(200);
    EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
    rig.want(Vec3(-0.005, 0, 0));
    run(300);
    loop->gate.enable();
    run(700);
    EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << describe(loop->gate.cause());
    if (!to_contact) return;
    rig.want(Vec3(0.010, 0, 0));
    run(300);
    EXPECT_LT(rig.motors().x(), -1.0);
  }

  JoystickRig rig{GetParam()};
  std::unique_ptr<WallLoop> loop;
};

TEST_P(JoystickFault, UnplugInContact) {
  rig.bus.detach(rig.port);
  EXPECT_LE(ms_to_zero(200), kFirmwareTimeout_ms);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kDisconnect);
  EXPECT_FALSE(loop->sample.connected);
  // Plugged in again it stays without force until it is opened, and then until the user arms it.
  rig.port = rig.bus.attach(rig.emulated);
  run(200);
  EXPECT_FALSE(loop->sample.connected);
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
  EXPECT_NE(std::string(rig.device->health().advice).find("Plug"), std::string::npos);
  SafetyGate latched = loop->gate;
  rig.open();
  loop = std::make_unique<WallLoop>(*rig.device);
  loop->gate = latched;
  expect_rearm_by_the_user_only();
}

TEST_P(JoystickFault, AStallOfFiveMillisecondsIsLivedThrough) {
  rig.faults().silent_until_ns = rig.bus.now_ns() + 5 * kMs;
  run(100);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone);
  EXPECT_LT(rig.motors().x(), -1.0);
}

TEST_P(JoystickFault, StallsOfTwentyAndAHundredMilliseconds) {
  for (const int stall_ms : {20, 100}) {
    SCOPED_TRACE(stall_ms);
    rig.faults().silent_until_ns = rig.bus.now_ns() + stall_ms * kMs;
    // The device hears nothing of our zero while it stalls: its own time-out must act.
    EXPECT_LE(ms_to_zero(300, 150), kFirmwareTimeout_ms);
    EXPECT_EQ(loop->gate.cause(), ForceOff::kDisconnect);
    expect_rearm_by_the_user_only();
  }
}

TEST_P(JoystickFault, AProgramThatStallsForFiveMillisecondsIsLivedThrough) {
  rig.pass_ms(5);
  run(100);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << describe(loop->gate.cause());
  EXPECT_LT(rig.motors().x(), -1.0);
}

// Its firmware ends the force on time; that it may not come back by itself is ours to see to.
TEST_P(JoystickFault, AProgramThatStallsForTwentyFiveOrAHundredMilliseconds) {
  for (const int stall_ms : {25, 100}) {
    SCOPED_TRACE(stall_ms);
    rig.pass_ms(kFirmwareTimeout_ms + 1);
    EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
    rig.pass_ms(stall_ms - kFirmwareTimeout_ms - 1);
    EXPECT_LE(ms_to_zero(300, 150), 1);
    EXPECT_EQ(loop->gate.cause(), ForceOff::kWatchdog) << describe(loop->gate.cause());
    expect_rearm_by_the_user_only();
  }
}

// The device hears us but we do not hear it: zero must be on its way after 10 ms.
TEST_P(JoystickFault, LateReports) {
  rig.faults().in_late_ns = 50 * kMs;
  EXPECT_LE(ms_to_zero(200), 10 + kZeroByReport_ms);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kDisconnect);
  rig.faults().in_late_ns = 0;
  run(100);
  expect_rearm_by_the_user_only();
}

TEST_P(JoystickFault, GarbageReports) {
  rig.faults().garbage_in = 100;
  EXPECT_LE(ms_to_zero(200), 10 + kZeroByReport_ms);
  // A random packet may look sound and leap: then the hand seems too fast.
  EXPECT_TRUE(loop->gate.cause() == ForceOff::kDeviceFault ||
              loop->gate.cause() == ForceOff::kVelocity)
      << describe(loop->gate.cause());
  EXPECT_GT(rig.device->health().bad_reports, 5u);
  expect_rearm_by_the_user_only();
}

TEST_P(JoystickFault, AFewGarbageReportsChangeNothing) {
  const Vec3 before = loop->sample.X_VD.p;
  rig.faults().garbage_in = 3;
  for (int i = 0; i < 5; ++i) {
    run(1);
    EXPECT_LT((loop->sample.X_VD.p - before).norm(), 1e-4);
  }
  run(50);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNone) << describe(loop->gate.cause());
  EXPECT_EQ(rig.device->health().bad_reports, 3u);
  EXPECT_LT(rig.motors().x(), -1.0);
}

TEST_P(JoystickFault, ShortReports) {
  rig.faults().short_in = 100;
  EXPECT_LE(ms_to_zero(200), 10 + kZeroByReport_ms);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kDeviceFault);
  expect_rearm_by_the_user_only();
}

TEST_P(JoystickFault, AShortOutTransfer) {
  rig.faults().short_out = 1;
  EXPECT_LE(ms_to_zero(200), kFirmwareTimeout_ms);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kDeviceFault);
  rig.device->calibrate();
  expect_rearm_by_the_user_only();
}

TEST_P(JoystickFault, StallOnEachEndpoint) {
  for (const bool in : {true, false}) {
    SCOPED_TRACE(in ? "IN" : "OUT");
    (in ? rig.faults().stall_in : rig.faults().stall_out) = true;
    EXPECT_LE(ms_to_zero(200), in ? kZeroByReport_ms : kFirmwareTimeout_ms + 1);
    EXPECT_EQ(loop->gate.cause(), ForceOff::kDeviceFault);
    loop->gate.enable();  // of no use while the device is at fault
    run(100);
    EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
    EXPECT_EQ(loop->gate.cause(), ForceOff::kDeviceFault);
    rig.device->calibrate();
    expect_rearm_by_the_user_only();
  }
}

TEST_P(JoystickFault, NotANumberFromAbove) {
  loop->add_nan = true;
  EXPECT_LE(ms_to_zero(200), kZeroByReport_ms);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kNotFinite);
  loop->add_nan = false;
  expect_rearm_by_the_user_only();
}

TEST_P(JoystickFault, NotANumberPastTheGateToo) {
  for (int i = 0; i < 5; ++i) {
    rig.pass_ms(1);
    rig.device->read();
    rig.device->write_force(Vec3(-1, std::nan(""), HUGE_VAL));
  }
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
}

TEST_P(JoystickFault, OverVelocity) {
  rig.want(Vec3(-0.075, 0.07, 0));  // a leap of the wish: the grip pulls the hand past 1 m/s
  Pose wanted;
  wanted.p = Vec3(-0.075, 0.07, 0);
  rig.mechanics->set_target(wanted, Vec3(-5, 5, 0), 0);
  EXPECT_LE(ms_to_zero(300), 100);
  EXPECT_EQ(loop->gate.cause(), ForceOff::kVelocity);
  expect_rearm_by_the_user_only();
}

// Over-temperature, lost calibration, a fault, a failed supply, an open switch: each in contact, as
// far as the dialect can tell it.
TEST_P(JoystickFault, WhatTheDeviceSaysOfItselfEndsTheForce) {
  struct Told {
    ForceOff cause;
    std::function<void(bool wrong)> tell;
  };
  const auto bit = [&](std::uint8_t which, bool when_wrong) {
    return [this, which, when_wrong](bool wrong) {
      rig.vector->set_status_bit(which, wrong == when_wrong);
    };
  };
  std::vector<Told> all;
  if (rig.vector)
    all = {{ForceOff::kTemperature, bit(VectorState::kTooWarm, true)},
           {ForceOff::kCalibration, bit(VectorState::kHomed, false)},
           {ForceOff::kDeviceFault, bit(VectorState::kFault, true)},
           {ForceOff::kDeadMan, bit(VectorState::kDeadManOpen, true)}};
  else
    all = {{ForceOff::kDeviceFault, [&](bool wrong) { rig.pid->set_switches(true, !wrong); }},
           {ForceOff::kDeadMan, [&](bool wrong) { rig.pid->set_switches(!wrong, true); }}};
  for (const Told& told : all) {
    SCOPED_TRACE(describe(told.cause));
    told.tell(true);
    EXPECT_LE(ms_to_zero(200), kZeroByReport_ms);
    EXPECT_EQ(loop->gate.cause(), told.cause) << describe(loop->gate.cause());
    loop->gate.enable();  // of no use while it lasts
    run(50);
    EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
    EXPECT_EQ(loop->gate.cause(), told.cause);
    told.tell(false);
    expect_rearm_by_the_user_only();
  }
}

TEST_P(JoystickFault, AHungHostIsTheFirmwaresToEnd) {
  int ms = 0;
  while (rig.motors() != Vec3(Vec3::Zero()) && ms < 100) {
    rig.pass_ms(1);
    ++ms;
  }
  // Counted from the last report, of which a few were still on their way.
  EXPECT_LE(ms, kFirmwareTimeout_ms + (rig.pid ? 4 : 1));
  EXPECT_GE(ms, kFirmwareTimeout_ms - 1);
}

TEST_P(JoystickFault, CloseInContactLeavesNoForce) {
  rig.device->close();
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
  if (rig.pid) {
    EXPECT_EQ(rig.pid->effects_playing(), 0);
    EXPECT_FALSE(rig.pid->actuators_on());
  }
  EXPECT_FALSE(rig.device->read().connected);
  rig.device->write_force(Vec3(1, 0, 0));
  rig.device->close();
  rig.pass_ms(50);
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
  // Another program may have it now.
  EXPECT_TRUE(rig.try_open());
}

TEST_P(JoystickFault, GoingOutOfScopeInContactLeavesNoForce) {
  loop.reset();
  rig.device.reset();
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
}

TEST_P(JoystickFault, ClosingAStalledDeviceEndsInTime) {
  rig.faults().silent_until_ns = rig.bus.now_ns() + 10'000 * kMs;
  const std::int64_t before = rig.bus.now_ns();
  rig.device->close();
  EXPECT_LT(rig.bus.now_ns() - before, 150 * kMs);
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
}

TEST_P(JoystickFault, LastForceWinsOnAStalledDevice) {
  // Forces of ever smaller size, so that each can be told from the others.
  rig.faults().silent_until_ns = rig.bus.now_ns() + 8 * kMs;
  const std::uint64_t taken = rig.device->health().reports_out;
  for (int i = 0; i < 8; ++i) {
    rig.pass_ms(1);
    rig.device->read();
    rig.device->write_force(Vec3(-8.0 + i, -8.0 + i, -8.0 + i));
  }
  const std::uint64_t taken_late = rig.device->health().reports_out;
  EXPECT_LE(taken_late - taken, 1u);
  for (int i = 0; i < 6; ++i) {
    rig.pass_ms(1);
    EXPECT_GT(rig.motors().minCoeff(), -5.5) << "an old force";
    rig.device->read();
    rig.device->write_force(Vec3::Constant(-1));
  }
  const Vec3 at_motors = rig.motors();
  EXPECT_LT((at_motors - Vec3::Constant(-1)).norm(), 2e-3) << at_motors.transpose();
  const DeviceHealth health = rig.device->health();
  EXPECT_GT(health.replaced, rig.pid ? 15u : 5u);
  EXPECT_LE(health.reports_out - taken_late, 6u);  // a frame takes one
}

INSTANTIATE_TEST_SUITE_P(, JoystickFault,
                         ::testing::Values(testing::kPidKind, testing::kPidByControlKind,
                                           testing::kVectorKind),
                         [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace osteon
