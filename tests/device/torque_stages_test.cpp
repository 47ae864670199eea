#include "osteon/device/torque_stages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/base/random.h"
#include "osteon/device/safety.h"
#include "osteon/device/virtual_device.h"

namespace osteon {
namespace {

constexpr double kGateTick_s = 0.001;
const double kNotATorque = std::numeric_limits<double>::quiet_NaN();

DeviceInfo six_axes() {
  DeviceInfo info;
  info.peak_force_n = 8;
  info.continuous_force_n = 8;
  info.torque_axes = {true, true, true};
  info.peak_torque_nm = 0.17;
  info.continuous_torque_nm = 0.048;
  info.max_torque_slew_nm_per_s = 20;
  return info;
}

// A gate that is past its ramp, behind a device that sends a new reading every tick.
struct TorqueRig {
  explicit TorqueRig(const DeviceInfo& info = six_axes(), const SafetyParams& params = {})
      : gate(info, params) {
    gate.enable();
    for (int i = 0; i < 600; ++i) tick({});
  }
  DeviceWrench tick(const DeviceWrench& wanted) {
    sample.time_ns += 1'000'000;
    return gate.filter(wanted, sample, 0, kGateTick_s);
  }
  // A torque that stays long enough for the slew limit.
  DeviceWrench hold(const DeviceWrench& wanted, int ticks = 50) {
    DeviceWrench given;
    for (int i = 0; i < ticks; ++i) given = tick(wanted);
    return given;
  }
  SafetyGate gate;
  DeviceSample sample;
};

TEST(TorqueStages, WithoutDrivenRotationThereIsNoneAndNothingTrips) {
  DeviceInfo info = six_axes();
  info.torque_axes = {false, false, false};
  TorqueRig rig(info);
  EXPECT_EQ(rig.hold({Vec3(1, 0, 0), Vec3(0.1, 0, 0)}).torque_V, Vec3::Zero());
  EXPECT_EQ(rig.tick({Vec3(1, 0, 0), Vec3(kNotATorque, 0, 0)}).force_V, Vec3(1, 0, 0));
  EXPECT_TRUE(rig.gate.enabled());
  EXPECT_EQ(rig.gate.state().torque_limit_nm, 0);
}

TEST(TorqueStages, WhatTheLimitsLeaveComesThroughAsItIs) {
  TorqueRig rig;
  const DeviceWrench wanted{Vec3(1, 2, -3), Vec3(0.02, -0.05, 0.01)};
  const DeviceWrench given = rig.hold(wanted);
  EXPECT_LT((given.torque_V - wanted.torque_V).norm(), 1e-15);
  EXPECT_LT((given.force_V - wanted.force_V).norm(), 1e-12);
}

TEST(TorqueStages, OnlyDrivenAxesCount) {
  DeviceInfo info = six_axes();
  info.torque_axes = {false, false, true};
  TorqueRig rig(info);
  EXPECT_LT((rig.hold({Vec3::Zero(), Vec3(5, 5, 0.1)}).torque_V - Vec3(0, 0, 0.1)).norm(), 1e-15);
}

TEST(TorqueStages, NeitherPeakNorRateIsEverExceeded) {
  DeviceInfo info = six_axes();
  info.continuous_torque_nm = info.peak_torque_nm;
  TorqueRig rig(info);
  Random random(5);
  Vec3 last = Vec3::Zero();
  double most = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 axis = random.direction();
    const Vec3 t = rig.tick({Vec3::Zero(), random.uniform(0, 2) * axis}).torque_V;
    ASSERT_LE(t.norm(), 0.17 + 1e-15);
    ASSERT_LE((t - last).norm(), 20 * kGateTick_s + 1e-15);
    most = std::max(most, t.norm());
    last = t;
  }
  EXPECT_GT(most, 0.05);
  EXPECT_NEAR(rig.hold({Vec3::Zero(), Vec3(0, 9, 0)}).torque_V.y(), 0.17, 1e-4);
}

// Warm motors: the peak for some seconds, then what they bear for ever.
TEST(TorqueStages, ALastingTorqueFallsToTheContinuousOne) {
  TorqueRig rig;
  EXPECT_NEAR(rig.hold({Vec3::Zero(), Vec3(0, 0, 1)}, 100).torque_V.z(), 0.17, 1e-9);
  const Vec3 late = rig.hold({Vec3::Zero(), Vec3(0, 0, 1)}, 40000).torque_V;
  EXPECT_LT(late.norm(), 0.17 * 0.4);
  EXPECT_GT(late.norm(), 0.048 - 1e-9);
}

TEST(TorqueStages, NotANumberGivesZeroOfBothAndLatches) {
  for (const Vec3& bad : {Vec3(kNotATorque, 0, 0), Vec3(0, HUGE_VAL, 0)}) {
    TorqueRig rig;
    rig.hold({Vec3(1, 0, 0), Vec3(0, 0.1, 0)});
    const DeviceWrench given = rig.tick({Vec3(1, 0, 0), bad});
    EXPECT_EQ(given.force_V, Vec3::Zero());
    EXPECT_EQ(given.torque_V, Vec3::Zero());
    EXPECT_EQ(rig.gate.cause(), ForceOff::kNotFinite);
    EXPECT_EQ(rig.tick({Vec3(1, 0, 0), Vec3(0, 0.1, 0)}).torque_V, Vec3::Zero());
  }
  TorqueRig rig;
  rig.sample.w_V.x() = kNotATorque;
  EXPECT_EQ(rig.tick({Vec3::Zero(), Vec3(0, 0.1, 0)}).torque_V, Vec3::Zero());
  EXPECT_EQ(rig.gate.cause(), ForceOff::kNotFinite);
}

// Whatever takes the force takes the torque in the same tick; both come back by the same ramp.
TEST(TorqueStages, AFaultTakesItToZeroAndTheRampBringsItBack) {
  const DeviceWrench wanted{Vec3(1, 0, 0), Vec3(0, 0.04, 0)};
  using Fault = void (*)(DeviceSample&);
  constexpr Fault kFaults[] = {[](DeviceSample& s) { s.connected = false; },
                               [](DeviceSample& s) { s.calibrated = false; },
                               [](DeviceSample& s) { s.dead_man_held = false; },
                               [](DeviceSample& s) { s.refusal = ForceOff::kTemperature; },
                               [](DeviceSample& s) { s.v_V.x() = 2; },
                               [](DeviceSample& s) { s.w_V.z() = -50; }};
  for (const Fault fault : kFaults) {
    TorqueRig rig;
    ASSERT_GT(rig.hold(wanted).torque_V.norm(), 0.03);
    const DeviceSample sound = rig.sample;
    fault(rig.sample);
    EXPECT_EQ(rig.tick(wanted).torque_V, Vec3::Zero());
    EXPECT_FALSE(rig.gate.enabled());
    const std::int64_t now = rig.sample.time_ns;
    rig.sample = sound;
    rig.sample.time_ns = now;
    EXPECT_EQ(rig.tick(wanted).torque_V, Vec3::Zero());
    rig.gate.enable();
    const DeviceWrench half = rig.hold(wanted, 250);
    EXPECT_NEAR(half.torque_V.y(), 0.02, 0.001);
    EXPECT_NEAR(half.force_V.x(), 0.5, 0.02);
  }
}

// A turning motor that is answered late by a torque which grows with the turn feeds the loop: the
// share that is passed on falls until the swing dies down.
TEST(TorqueStages, ASwingThatDoesNotDieDownLosesItsStiffness) {
  for (const bool on : {false, true}) {
    SafetyParams params;
    params.passivity.on = on;
    TorqueRig rig(six_axes(), params);
    // A stylus of 1e-5 kg m2 in a hand without damping, on a wall of 2 N m/rad that is told late.
    constexpr double kInertia = 1e-5, kWall = 2.0;
    double angle = 0, rate = 2, before = 0, most_late = 0;
    for (int i = 0; i < 3000; ++i) {
      rig.sample.X_VD.q = Quat(Eigen::AngleAxisd(angle, Vec3::UnitX()));
      rig.sample.w_V = Vec3(rate, 0, 0);
      const double told =
          rig.tick({Vec3::Zero(), Vec3(before > 0 ? -kWall * before : 0, 0, 0)}).torque_V.x();
      before = angle;
      rate += kGateTick_s * (told - 0.02 * angle - 2e-5 * rate) / kInertia;
      angle += kGateTick_s * rate;
      if (i > 2500) most_late = std::max(most_late, std::abs(angle));
      if (!rig.gate.enabled()) break;
    }
    if (on)
      EXPECT_LT(most_late, 0.05);
    else
      EXPECT_TRUE(!rig.gate.enabled() || most_late > 0.05) << most_late;
  }
}

TEST(VirtualDeviceTorque, GoesOutWithTheNextForceAndThatOneAlone) {
  DeviceInfo info = six_axes();
  info.torque_axes = {true, false, true};
  VirtualDevice device(info);
  device.write({Vec3(1, 0, 0), Vec3(0.1, 0.2, -0.3)});
  EXPECT_EQ(device.torque_V(), Vec3(0.1, 0, -0.3));
  device.write_force(Vec3(1, 0, 0));
  EXPECT_EQ(device.torque_V(), Vec3::Zero());
  device.write({Vec3(1, 0, 0), Vec3(kNotATorque, 0, 0)});
  EXPECT_EQ(device.torque_V(), Vec3::Zero());
  device.write({Vec3(1, 0, 0), Vec3(0.1, 0, 0)});
  device.close();
  EXPECT_EQ(device.torque_V(), Vec3::Zero());
}

}  // namespace
}  // namespace osteon
