#include "osteon/device/safety.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kSafetyDt = 0.001;
const double kNoNumber = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

DeviceInfo test_device() {
  DeviceInfo info;
  info.peak_force_n = 8;
  info.continuous_force_n = 8;
  info.max_slew_n_per_s = 4000;
  return info;
}

// A gate behind a device that sends a new reading every tick.
struct GateRig {
  SafetyGate gate;
  std::int64_t time_ns = 0;

  DeviceSample fresh(DeviceSample sample = {}) {
    sample.time_ns = (time_ns += 1'000'000);
    return sample;
  }
  Vec3 filter(const Vec3& force, DeviceSample sample = {}, double age_s = 0,
              double dt_s = kSafetyDt) {
    return gate.filter(force, fresh(sample), age_s, dt_s);
  }
  void enable() { gate.enable(); }
  void disable(ForceOff cause) { gate.disable(cause); }
  bool enabled() const { return gate.enabled(); }
  ForceOff cause() const { return gate.cause(); }
};

GateRig new_rig(const DeviceInfo& info, const SafetyParams& params = {}) {
  return {SafetyGate(info, params)};
}

// An enabled gate whose ramp is over.
GateRig ready_gate(const DeviceInfo& info, const SafetyParams& params = {}) {
  GateRig rig = new_rig(info, params);
  rig.enable();
  for (int i = 0; i < 600; ++i) rig.filter(Vec3::Zero());
  return rig;
}

DeviceSample moving(const Vec3& v) {
  DeviceSample sample;
  sample.v_V = v;
  return sample;
}

TEST(SafetyGate, StartsOffAndStaysOffUntilEnabled) {
  GateRig gate = new_rig(test_device());
  EXPECT_FALSE(gate.enabled());
  EXPECT_EQ(gate.cause(), ForceOff::kSoftware);
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(gate.filter(Vec3(5, 0, 0), {}, 0, kSafetyDt), Vec3(Vec3::Zero()));
}

TEST(SafetyGate, NotFiniteGivesZeroAndLatches) {
  for (const Vec3& bad : {Vec3(kNoNumber, 0, 0), Vec3(0, kInf, 0), Vec3(0, 0, -kInf)}) {
    GateRig gate = ready_gate(test_device());
    EXPECT_EQ(gate.filter(bad, {}, 0, kSafetyDt), Vec3(Vec3::Zero()));
    EXPECT_EQ(gate.cause(), ForceOff::kNotFinite);
    for (int i = 0; i < 100; ++i)
      ASSERT_EQ(gate.filter(Vec3(1, 0, 0), {}, 0, kSafetyDt), Vec3(Vec3::Zero()));
    gate.enable();
    EXPECT_TRUE(gate.enabled());
    EXPECT_GT(gate.filter(Vec3(1, 0, 0), {}, 0, kSafetyDt).x(), 0);
  }
}

TEST(SafetyGate, ASampleOrAgeThatIsNotFiniteTripsToo) {
  GateRig a = ready_gate(test_device());
  EXPECT_EQ(a.filter(Vec3(1, 0, 0), moving(Vec3(kNoNumber, 0, 0)), 0, kSafetyDt),
            Vec3(Vec3::Zero()));
  EXPECT_EQ(a.cause(), ForceOff::kNotFinite);
  GateRig b = ready_gate(test_device());
  EXPECT_EQ(b.filter(Vec3(1, 0, 0), {}, kNoNumber, kSafetyDt), Vec3(Vec3::Zero()));
  EXPECT_EQ(b.cause(), ForceOff::kNotFinite);
}

TEST(SafetyGate, SlewBoundsEveryChange) {
  GateRig gate = ready_gate(test_device());
  Random random(3);
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < 2000; ++i) {
    const Vec3 dir = random.direction();
    const double size = random.uniform(0, 20);
    const Vec3 f = gate.filter(size * dir, {}, 0, kSafetyDt);
    ASSERT_LE((f - last).norm(), 4000 * kSafetyDt + 1e-12);
    ASSERT_LE(f.norm(), 8 + 1e-12);
    last = f;
  }
}

TEST(SafetyGate, ABrokenClockLetsNothingChange) {
  for (const double dt : {0.0, -1.0, kNoNumber, kInf}) {
    GateRig gate = ready_gate(test_device());
    const Vec3 before = gate.filter(Vec3(1, 0, 0), {}, 0, kSafetyDt);
    EXPECT_EQ(gate.filter(Vec3(-5, 3, 0), {}, 0, dt), before) << dt;
    EXPECT_TRUE(gate.enabled());
  }
}

TEST(SafetyGate, PeakClampKeepsTheDirection) {
  GateRig gate = ready_gate(test_device());
  const Vec3 wanted(30, -40, 10);
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 50; ++i) f = gate.filter(wanted, {}, 0, kSafetyDt);
  EXPECT_NEAR(f.norm(), 8, 1e-12);
  EXPECT_LT((f.normalized() - wanted.normalized()).norm(), 1e-9);
}

TEST(SafetyGate, AxesWithoutMotorsGetNothingAndDoNotEatThePeak) {
  DeviceInfo info = test_device();
  info.force_axes = {true, false, true};
  GateRig gate = ready_gate(info);
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 50; ++i) f = gate.filter(Vec3(3, 100, -4), {}, 0, kSafetyDt);
  EXPECT_EQ(f.y(), 0);
  EXPECT_NEAR(f.x(), 3, 1e-9);
  EXPECT_NEAR(f.z(), -4, 1e-9);
}

TEST(SafetyGate, HotMotorsFallToTheContinuousForceAndRecover) {
  DeviceInfo info = test_device();
  info.continuous_force_n = 2;
  SafetyParams params;
  params.thermal_s = 1.0;
  GateRig gate = ready_gate(info, params);
  const auto press = [&](double newtons, int ticks) {
    Vec3 f = Vec3::Zero();
    for (int i = 0; i < ticks; ++i) f = gate.filter(Vec3(newtons, 0, 0), {}, 0, kSafetyDt);
    return f.x();
  };
  EXPECT_NEAR(press(8, 10), 8, 1e-9);  // the peak at first
  double hot = 0;
  double square = 0;
  press(8, 10000);
  for (int i = 0; i < 4000; ++i) {
    hot = press(8, 1);
    square += hot * hot;
  }
  EXPECT_LE(std::sqrt(square / 4000),
            2.0 + 1e-9);  // lasting load: no more than the continuous force
  EXPECT_GT(hot, 1.5);
  press(0, 5000);
  EXPECT_NEAR(press(8, 10), 8, 1e-9);
}

TEST(SafetyGate, OverVelocityTripsAndLatches) {
  GateRig gate = ready_gate(test_device());
  for (int i = 0; i < 5; ++i) gate.filter(Vec3(1, 0, 0), moving(Vec3(0.6, 0.7, 0.3)), 0, kSafetyDt);
  EXPECT_TRUE(gate.enabled());  // 0.97 m/s
  EXPECT_EQ(gate.filter(Vec3(1, 0, 0), moving(Vec3(0.8, 0.8, 0)), 0, kSafetyDt),
            Vec3(Vec3::Zero()));
  EXPECT_EQ(gate.cause(), ForceOff::kVelocity);
  EXPECT_EQ(gate.filter(Vec3(1, 0, 0), {}, 0, kSafetyDt), Vec3(Vec3::Zero()));
  // A second trip does not hide the first cause.
  gate.filter(Vec3(kNoNumber, 0, 0), {}, 0, kSafetyDt);
  EXPECT_EQ(gate.cause(), ForceOff::kVelocity);
}

TEST(SafetyGate, RampsInLinearlyAfterEnabling) {
  GateRig gate = new_rig(test_device());
  gate.enable();
  for (int i = 1; i <= 500; ++i) {
    const double f = gate.filter(Vec3(4, 0, 0), {}, 0, kSafetyDt).x();
    ASSERT_LE(f, 4.0 * i / 500 + 1e-9);
    if (i > 2) {
      ASSERT_NEAR(f, 4.0 * i / 500, 1e-9);
    }
  }
  EXPECT_NEAR(gate.filter(Vec3(4, 0, 0), {}, 0, kSafetyDt).x(), 4, 1e-12);
}

TEST(SafetyGate, StaleForceDecaysThenTheWatchdogLatches) {
  GateRig gate = ready_gate(test_device());
  for (int i = 0; i < 10; ++i) gate.filter(Vec3(4, 0, 0), {}, 0, kSafetyDt);
  double last = 4;
  for (int ms = 1; ms < 50; ++ms) {
    const double f = gate.filter(Vec3(4, 0, 0), {}, ms * kSafetyDt, kSafetyDt).x();
    if (ms <= 20) {
      EXPECT_NEAR(f, 4, 1e-9);
    } else {
      EXPECT_NEAR(f, 4.0 * (50 - ms) / 30, 1e-9);
      EXPECT_LT(f, last);
    }
    last = f;
  }
  EXPECT_EQ(gate.filter(Vec3(4, 0, 0), {}, 0.050001, kSafetyDt), Vec3(Vec3::Zero()));
  EXPECT_EQ(gate.cause(), ForceOff::kWatchdog);
  EXPECT_EQ(gate.filter(Vec3(4, 0, 0), {}, 0, kSafetyDt), Vec3(Vec3::Zero()));
}

TEST(SafetyGate, AfterAShortStallTheForceRampsInAgain) {
  GateRig gate = ready_gate(test_device());
  for (int i = 0; i < 10; ++i) gate.filter(Vec3(4, 0, 0), {}, 0, kSafetyDt);
  const double stalled = gate.filter(Vec3(4, 0, 0), {}, 0.035, kSafetyDt).x();
  EXPECT_NEAR(stalled, 2, 1e-9);
  EXPECT_NEAR(gate.filter(Vec3(4, 0, 0), {}, 0, kSafetyDt).x(), stalled + 4 * kSafetyDt / 0.5,
              1e-9);
  EXPECT_TRUE(gate.enabled());
}

TEST(SafetyGate, UnpluggedDeviceTrips) {
  GateRig gate = ready_gate(test_device());
  DeviceSample gone;
  gone.connected = false;
  EXPECT_EQ(gate.filter(Vec3(1, 0, 0), gone, 0, kSafetyDt), Vec3(Vec3::Zero()));
  EXPECT_EQ(gate.cause(), ForceOff::kDisconnect);
}

TEST(SafetyGate, DisableNamesItsCauseAndEveryCauseHasWords) {
  GateRig gate = ready_gate(test_device());
  gate.disable(ForceOff::kDeadMan);
  EXPECT_EQ(gate.cause(), ForceOff::kDeadMan);
  EXPECT_EQ(gate.filter(Vec3(1, 0, 0), {}, 0, kSafetyDt), Vec3(Vec3::Zero()));
  gate.enable();
  gate.disable(ForceOff::kNone);
  EXPECT_EQ(gate.cause(), ForceOff::kSoftware);
  for (int c = 0; c <= static_cast<int>(ForceOff::kDeviceFault); ++c)
    EXPECT_GT(std::string(describe(static_cast<ForceOff>(c))).size(), 10u);
}

TEST(SafetyGate, WhatTheDeviceRefusesTripsWithItsOwnCause) {
  for (const ForceOff cause : {ForceOff::kTemperature, ForceOff::kDeviceFault, ForceOff::kButton}) {
    GateRig gate = ready_gate(test_device());
    DeviceSample refused;
    refused.refusal = cause;
    EXPECT_EQ(gate.filter(Vec3(1, 0, 0), refused), Vec3(Vec3::Zero()));
    EXPECT_EQ(gate.cause(), cause);
    EXPECT_EQ(gate.filter(Vec3(1, 0, 0)), Vec3(Vec3::Zero()));  // and latches
  }
}

TEST(SafetyGate, LostCalibrationAndALetGoDeadManLatch) {
  GateRig a = ready_gate(test_device());
  DeviceSample lost;
  lost.calibrated = false;
  EXPECT_EQ(a.filter(Vec3(1, 0, 0), lost), Vec3(Vec3::Zero()));
  EXPECT_EQ(a.cause(), ForceOff::kCalibration);
  EXPECT_EQ(a.filter(Vec3(1, 0, 0)), Vec3(Vec3::Zero()));
  GateRig b = ready_gate(test_device());
  DeviceSample let_go;
  let_go.dead_man_held = false;
  EXPECT_EQ(b.filter(Vec3(1, 0, 0), let_go), Vec3(Vec3::Zero()));
  EXPECT_EQ(b.cause(), ForceOff::kDeadMan);
  b.enable();  // still let go: the wish alone does not arm it
  EXPECT_EQ(b.filter(Vec3(1, 0, 0), let_go), Vec3(Vec3::Zero()));
  EXPECT_EQ(b.cause(), ForceOff::kDeadMan);
}

// A device that sends nothing new for `ms`, in contact; then it goes on.
GateRig stalled(int ms, double* largest_after_10_ms) {
  GateRig gate = ready_gate(test_device());
  for (int i = 0; i < 10; ++i) gate.filter(Vec3(4, 0, 0));
  const DeviceSample old = gate.fresh();
  gate.gate.filter(Vec3(4, 0, 0), old, 0, kSafetyDt);
  *largest_after_10_ms = 0;
  for (int i = 1; i <= ms; ++i) {
    const double f = gate.gate.filter(Vec3(4, 0, 0), old, 0, kSafetyDt).norm();
    if (i > 10) *largest_after_10_ms = std::max(*largest_after_10_ms, f);
  }
  return gate;
}

TEST(SafetyGate, AStallOf5MsPassesUnfelt) {
  double late = 0;
  GateRig gate = stalled(5, &late);
  EXPECT_TRUE(gate.enabled());
  EXPECT_NEAR(gate.filter(Vec3(4, 0, 0)).x(), 4, 1e-9);
}

TEST(SafetyGate, AStallOf15MsIsZeroAndThenRampsInAgain) {
  double late = 1;
  GateRig gate = stalled(15, &late);
  EXPECT_EQ(late, 0);
  EXPECT_TRUE(gate.enabled());
  EXPECT_NEAR(gate.filter(Vec3(4, 0, 0)).x(), 4 * kSafetyDt / 0.5, 1e-9);
}

TEST(SafetyGate, AStallOf20Or100MsIsAFaultThatLatches) {
  for (const int ms : {20, 100}) {
    double late = 1;
    GateRig gate = stalled(ms, &late);
    EXPECT_EQ(late, 0) << ms;
    EXPECT_EQ(gate.cause(), ForceOff::kDisconnect) << ms;
    for (int i = 0; i < 1000; ++i)
      ASSERT_EQ(gate.filter(Vec3(4, 0, 0)), Vec3(Vec3::Zero())) << "re-armed by itself";
    gate.enable();
    for (int i = 0; i < 600; ++i) gate.filter(Vec3(4, 0, 0));
    EXPECT_NEAR(gate.filter(Vec3(4, 0, 0)).x(), 4, 1e-9);
  }
}

TEST(SafetyGate, AStallOfTheLoopItselfRampsInAgainWithoutAFault) {
  GateRig gate = ready_gate(test_device());
  for (int i = 0; i < 10; ++i) gate.filter(Vec3(4, 0, 0));
  EXPECT_EQ(gate.filter(Vec3(4, 0, 0), {}, 0, 0.033), Vec3(Vec3::Zero()));
  EXPECT_TRUE(gate.enabled());
  EXPECT_NEAR(gate.filter(Vec3(4, 0, 0)).x(), 4 * kSafetyDt / 0.5, 1e-9);
}

TEST(SafetyGate, AssistPassesByThePassivityStageButNotTheLimits) {
  GateRig gate = ready_gate(test_device());
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 50; ++i) {
    DeviceSample sample = moving(Vec3(0.1, 0, 0));
    sample.X_VD.p.x() = 0.1 * i * kSafetyDt;
    f = gate.gate.filter(Vec3::Zero(), gate.fresh(sample), 0, kSafetyDt, Vec3(0.4, 0, 0));
  }
  EXPECT_NEAR(f.x(), 0.4, 1e-9);  // along the motion: as energy it would have been braked
  EXPECT_EQ(gate.gate.state().passivity.energy_j, 0);
  for (int i = 0; i < 50; ++i)
    f = gate.gate.filter(Vec3::Zero(), gate.fresh(), 0, kSafetyDt, Vec3(100, 0, 0));
  EXPECT_LE(f.norm(), 8 + 1e-12);
  f = gate.gate.filter(Vec3(1, 0, 0), gate.fresh(), 0, kSafetyDt, Vec3(kNoNumber, 0, 0));
  EXPECT_TRUE(is_finite(f));
}

TEST(SafetyGate, ItsStateTellsWhatTheWindowShows) {
  GateRig gate = new_rig(test_device());
  EXPECT_EQ(gate.gate.state().cause, ForceOff::kSoftware);
  EXPECT_EQ(gate.gate.state().gain, 0);
  gate.enable();
  for (int i = 0; i < 250; ++i) {
    DeviceSample sample;
    sample.X_VD.p.x() = -0.00001 * i;
    gate.filter(Vec3(1, 0, 0), sample);
  }
  const SafetyState state = gate.gate.state();
  EXPECT_EQ(state.cause, ForceOff::kNone);
  EXPECT_NEAR(state.gain, 0.5, 1e-9);
  EXPECT_EQ(state.limit_n, 8);
  EXPECT_GT(state.passivity.energy_j, 0);
}

// Anything may come in: the output is finite, within the peak, bounded in its rise, and zero while
// off; and only `enable` arms.
TEST(SafetyGate, WhateverComesInTheOutputKeepsItsBounds) {
  Random random(77);
  const double odd[] = {kNoNumber, kInf, -kInf, 1e308, -1e308, 1e-320, 0.0, -0.0};
  const auto value = [&](double size) {
    if (random.uniform() < 0.02) return odd[random.next() % 8];
    return random.uniform(-size, size);
  };
  const auto vector = [&](double size) {
    const double x = value(size), y = value(size), z = value(size);
    return Vec3(x, y, z);
  };
  for (int stream = 0; stream < 60; ++stream) {
    DeviceInfo info = test_device();
    info.continuous_force_n = stream % 2 ? 2 : 8;
    SafetyGate gate(info);
    Vec3 last = Vec3::Zero();
    std::int64_t time_ns = 0;
    bool armed = false;
    int felt = 0;
    for (int i = 0; i < 2000; ++i) {
      if (random.uniform() < 0.02) {
        gate.enable();
        armed = true;
        last.setZero();
      }
      if (random.uniform() < 0.002) gate.disable(ForceOff::kButton);
      DeviceSample sample;
      const double step = random.uniform();
      time_ns += step < 0.9 ? 1'000'000 : step < 0.95 ? 0 : -50'000'000;
      sample.time_ns = time_ns;
      // Mostly sound readings, or hardly anything would pass stages 1 and 2.
      if (random.uniform() < 0.01) sample.X_VD.p = vector(0.3);
      if (random.uniform() < 0.3) sample.v_V = vector(0.5);
      sample.connected = random.uniform() > 0.001;
      sample.dead_man_held = random.uniform() > 0.001;
      const double dt = random.uniform() < 0.9 ? kSafetyDt : value(0.05);
      const double age = random.uniform() < 0.9 ? 0 : value(0.03);
      const Vec3 force = random.uniform() < 0.9 ? Vec3(3, 2, 1) : vector(50);
      const Vec3 f = gate.filter(force, sample, age, dt, vector(0.2));
      ASSERT_TRUE(is_finite(f));
      ASSERT_LE(f.norm(), 8 + 1e-9);
      if (!gate.enabled() || !armed) {
        ASSERT_EQ(f, Vec3(Vec3::Zero()));
      }
      // Rises by no more than slew and ramp allow in the longest tick that counts; falls at will.
      ASSERT_LE(f.norm() - last.norm(), 4000 * 0.005 + 1e-9);
      if (dt == kSafetyDt) {
        ASSERT_LE(f.norm() - last.norm(), 4000 * kSafetyDt + 8 * kSafetyDt / 0.5 + 1e-9);
      }
      if (!gate.enabled()) armed = false;
      felt += f.norm() > 0 ? 1 : 0;
      last = f;
      ASSERT_TRUE(std::isfinite(gate.state().passivity.energy_j));
    }
    EXPECT_GT(felt, 50) << "the stream shows little";
  }
}

}  // namespace
}  // namespace osteon
