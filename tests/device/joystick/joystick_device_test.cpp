#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>

#include "device/joystick/joystick_rig.h"
#include "emulated/joystick_descriptors.h"
#include "joystick/joystick_driver.h"
#include "joystick/vector_report.h"
#include "osteon/base/file.h"
#include "osteon/base/random.h"
#include "osteon/device/profile.h"
#include "velocity_estimator.h"

namespace osteon {
namespace {

using testing::JoystickRig;
using testing::kMs;

constexpr auto kPid = JoystickDialectKind::kPid;
constexpr auto kVector = JoystickDialectKind::kVector;

class JoystickDeviceTest : public ::testing::TestWithParam<testing::JoystickKind> {
 protected:
  void run(int ticks, const Vec3& force_V = Vec3::Zero()) {
    for (int i = 0; i < ticks; ++i) {
      rig.pass_ms(1);
      sample = rig.device->read();
      rig.device->write_force(force_V);
    }
  }
  JoystickRig rig{GetParam()};
  DeviceSample sample;
};

TEST_P(JoystickDeviceTest, EveryAxisAndTheRotationAreReadInTheirSense) {
  Pose wanted;
  wanted.p = Vec3(0.03, -0.05, 0.02);
  wanted.q = Quat(Eigen::AngleAxisd(0.7, Vec3::UnitZ()));
  rig.mechanics->set_target(wanted, Vec3::Zero(), 5);
  rig.open();
  run(600);
  EXPECT_LT((sample.X_VD.p - wanted.p).norm(), 5e-6) << sample.X_VD.p.transpose();
  EXPECT_LT(sample.X_VD.q.angularDistance(wanted.q), 2e-4);
  EXPECT_EQ(sample.buttons, 5u);
  EXPECT_LT(sample.v_V.norm(), 1e-3);
}

TEST_P(JoystickDeviceTest, EveryAxisIsDrivenInItsSense) {
  rig.open();
  for (int i = 0; i < 3; ++i)
    for (const double newtons : {1.234, -5.678}) {
      const Vec3 force = newtons * Vec3::Unit(i);
      run(20, force);
      EXPECT_LT((rig.motors() - force).norm(), 1.1e-3) << rig.motors().transpose();
    }
}

TEST_P(JoystickDeviceTest, AnAxisThatTheProfileDoesNotDriveGetsNothing) {
  rig.profile.info.force_axes = {true, false, true};
  rig.open();
  run(20, Vec3(1, 2, 3));
  EXPECT_LT((rig.motors() - Vec3(1, 0, 3)).norm(), 2e-3);
}

TEST_P(JoystickDeviceTest, VelocitiesFollowTheHand) {
  rig.open();
  Pose wanted;
  double worst = 0;
  double turn_worst = 0;
  for (int n = 0; n < 3000; ++n) {
    const double t = 1e-3 * n;
    wanted.p = Vec3(0.03 * std::sin(6 * t), 0, 0);
    wanted.q = Quat(Eigen::AngleAxisd(2 * t, Vec3::UnitZ()));  // more than half a turn
    rig.mechanics->set_target(wanted, Vec3(0.18 * std::cos(6 * t), 0, 0), 0);
    run(1);
    if (n < 100) continue;
    worst = std::max(worst, (sample.v_V - rig.mechanics->hand().velocity()).norm());
    turn_worst = std::max(turn_worst, (sample.w_V - Vec3(0, 0, 2)).norm());
  }
  // A step of position in a tick, and the window's lag.
  EXPECT_LT(worst, GetParam().dialect == kPid ? 0.006 : 0.0006);
  EXPECT_LT(turn_worst, 0.2);
}

TEST_P(JoystickDeviceTest, TheDeadManButtonMustBeHeld) {
  rig.profile.dead_man_button = 1;
  rig.profile.info.has_dead_man = true;
  rig.want(Vec3::Zero(), 0);
  rig.open();
  run(50, Vec3(1, 0, 0));
  EXPECT_FALSE(sample.dead_man_held);
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
  rig.want(Vec3::Zero(), 2);
  run(50, Vec3(1, 0, 0));
  EXPECT_TRUE(sample.dead_man_held);
  EXPECT_GT(rig.motors().x(), 0.99);
  rig.want(Vec3::Zero(), 0);
  run(6, Vec3(1, 0, 0));
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
}

TEST_P(JoystickDeviceTest, ADeviceThatNeverAnswersIsRefusedInTime) {
  rig.faults().silent_until_ns = 1'000'000 * kMs;
  const auto device = rig.try_open();
  ASSERT_FALSE(device);
  EXPECT_LT(rig.bus.now_ns(), 2000 * kMs);
  EXPECT_NE(device.error().todo.find("Plug"), std::string::npos);
}

TEST_P(JoystickDeviceTest, HealthCountsReports) {
  rig.open();
  run(100, Vec3(1, 0, 0));
  const DeviceHealth health = rig.device->health();
  EXPECT_EQ(health.calibration, Calibration::kDone);
  EXPECT_STREQ(health.advice, "");
  EXPECT_GE(health.reports_in, 100u);
  EXPECT_GE(health.reports_out, 99u);
  EXPECT_EQ(health.bad_reports, 0u);
}

INSTANTIATE_TEST_SUITE_P(, JoystickDeviceTest,
                         ::testing::Values(testing::kPidKind, testing::kPidByControlKind,
                                           testing::kVectorKind),
                         [](const auto& instance) { return instance.param.name; });

TEST(PidJoystick, SlowBlockLoadsAreAskedForAgainUpToSixtyTimes) {
  JoystickRig slow(kPid);
  slow.pid->set_slow_loads(59);
  EXPECT_TRUE(slow.try_open());
  JoystickRig dead(kPid);
  dead.pid->set_slow_loads(1000);
  const auto device = dead.try_open();
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().what.find("load an effect"), std::string::npos);
}

TEST(PidJoystick, WithoutRoomForThreeEffectsItIsRefused) {
  JoystickRig rig(kPid);
  rig.pid->set_room(2);
  const auto device = rig.try_open();
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().what.find("no room"), std::string::npos);
}

TEST(PidJoystick, ARefusedControlIsNamed) {
  JoystickRig rig(kPid);
  rig.faults().stall_control = true;
  const auto device = rig.try_open();
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().what.find("STALL"), std::string::npos) << device.error().message();
}

TEST(PidJoystick, ItsOwnSwitchesCutTheForceAndSayWhy) {
  JoystickRig rig(kPid);
  rig.open();
  const auto run = [&](int ticks) {
    DeviceSample sample;
    for (int i = 0; i < ticks; ++i) {
      rig.pass_ms(1);
      sample = rig.device->read();
      rig.device->write_force(Vec3(1, 0, 0));
    }
    return sample;
  };
  run(20);
  EXPECT_GT(rig.motors().x(), 0.99);
  rig.pid->set_switches(false, true);
  EXPECT_FALSE(run(5).dead_man_held);
  rig.pid->set_switches(true, false);
  EXPECT_EQ(run(5).refusal, ForceOff::kDeviceFault);
  rig.pid->set_switches(true, true);
  EXPECT_EQ(run(10).refusal, ForceOff::kNone);
  EXPECT_GT(rig.motors().x(), 0.99);
}

TEST(PidJoystick, AtFullSpeedOneAxisIsRefreshedInAFrame) {
  JoystickRig rig(kPid);
  rig.open();
  const std::uint64_t before = rig.device->health().reports_out;
  for (int i = 0; i < 300; ++i) {
    rig.pass_ms(1);
    rig.device->read();
    rig.device->write_force(Vec3(1, 1, 1));
  }
  EXPECT_NEAR(static_cast<double>(rig.device->health().reports_out - before), 300, 2);
}

// What changes most goes first; what changes less is not forgotten, what stands still is told anew.
TEST(PidJoystick, AtFullSpeedTheAxisThatIsFarthestOffGoesFirst) {
  for (const testing::JoystickKind& kind : {testing::kPidKind, testing::kPidByControlKind}) {
    SCOPED_TRACE(kind.name);
    JoystickRig rig(kind);
    rig.open();
    const auto tick = [&](const Vec3& force_V) {
      rig.device->read();
      rig.device->write_force(force_V);
      rig.pass_ms(1);
      return rig.motors();
    };
    for (int i = 0; i < 20; ++i) tick(Vec3(0.1, 0.1, 0.1));
    Vec3 wanted(0.1, 0.1, 0.1);
    for (int i = 1; i <= 30; ++i) {
      wanted = Vec3(0.1 + 0.001 * i, 0.1 + 0.1 * i, 0.1);
      const Vec3 motors = tick(wanted);
      // x waits while its small way adds up; y gives way to it now and then, and once to z.
      EXPECT_LT(std::abs(motors.y() - wanted.y()), 0.201) << i;
      EXPECT_LT(std::abs(motors.x() - wanted.x()), 0.02) << i;
    }
    for (int i = 0; i < 2; ++i) tick(wanted);
    EXPECT_LT((tick(wanted) - wanted).norm(), 2e-3);
  }
}

TEST(PidJoystick, WithoutAnOutEndpointNothingIsSentToOne) {
  JoystickRig rig(testing::kPidByControlKind);
  const auto configuration = pid_joystick_descriptors(false).configuration;
  EXPECT_EQ(configuration.size(), configuration[2]);  // as long as it says
  EXPECT_EQ(configuration[13], 1);                    // one endpoint
  rig.open();
  rig.pid->take_out(0x02, std::array<std::uint8_t, 4>{5, 1, 0x10, 0x27});
  rig.pass_ms(1);
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
  rig.device->read();
  rig.device->write_force(Vec3(0, 2, 0));
  rig.pass_ms(1);
  EXPECT_LT((rig.motors() - Vec3(0, 2, 0)).norm(), 2e-3);
  // A vector joystick has no reports to send so.
  UsbChannel plain = rig.profile.channel;
  plain.reports_by_control = false;
  UsbEntry entry = rig.emulated->entry();
  entry.port = rig.port;
  rig.device.reset();
  EXPECT_FALSE(rig.bus.open(entry, plain));
}

TEST(VectorJoystick, StatusBitsBecomeCauses) {
  using S = VectorState;
  const struct {
    std::uint8_t bit;
    bool on;
    ForceOff cause;
  } bits[] = {{0x08, true, ForceOff::kTemperature}, {0x10, true, ForceOff::kDeviceFault}};
  for (const auto& b : bits) {
    JoystickRig rig(kVector);
    rig.open();
    rig.vector->set_status_bit(b.bit, b.on);
    rig.pass_ms(1);
    EXPECT_EQ(rig.device->read().refusal, b.cause);
  }
  JoystickRig rig(kVector);
  rig.open();
  rig.vector->set_status_bit(S::kDeadManOpen, true);
  rig.pass_ms(1);
  EXPECT_FALSE(rig.device->read().dead_man_held);
}

TEST(VectorJoystick, TellsWhichHandleIsPutOn) {
  JoystickRig rig(kVector);
  rig.open();
  rig.pass_ms(2);
  EXPECT_EQ(rig.device->read().instrument_code, 0);
  rig.vector->set_instrument(38);
  rig.pass_ms(2);
  EXPECT_EQ(rig.device->read().instrument_code, 38);
  rig.vector->set_instrument(0);
  rig.pass_ms(2);
  EXPECT_EQ(rig.device->read().instrument_code, 0);
}

TEST(VectorJoystick, HomesWhenTheUserAsksAndGivesNoForceBefore) {
  JoystickRig rig(kVector);
  rig.vector->set_status_bit(VectorState::kHomed, false);
  rig.open();
  const auto run = [&](int ticks) {
    DeviceSample sample;
    for (int i = 0; i < ticks; ++i) {
      rig.pass_ms(1);
      sample = rig.device->read();
      rig.device->write_force(Vec3(1, 0, 0));
    }
    return sample;
  };
  EXPECT_FALSE(run(20).calibrated);
  EXPECT_EQ(rig.motors(), Vec3(Vec3::Zero()));
  EXPECT_NE(std::string(rig.device->health().advice).find("Calibrate"), std::string::npos);
  rig.device->calibrate();
  EXPECT_TRUE(run(20).calibrated);
  EXPECT_GT(rig.motors().x(), 0.99);
}

TEST(VectorJoystick, AHostThatSleptIsToldSo) {
  JoystickRig rig(kVector);
  rig.open();
  for (int i = 0; i < 20; ++i) {
    rig.pass_ms(1);
    rig.device->read();
    rig.device->write_force(Vec3(1, 0, 0));
  }
  rig.pass_ms(40);
  EXPECT_EQ(rig.device->read().refusal, ForceOff::kWatchdog);
}

TEST(JoystickDriver, FindsJoysticksByProfileAndTellsThemApartBySerial) {
  EmulatedUsbBus bus;
  const auto profiles =
      load_joystick_profiles(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets" / "devices");
  EXPECT_TRUE(profiles.problems.empty());
  EXPECT_EQ(profiles.sound.size(), 3u);
  EXPECT_TRUE(list_joysticks(bus, profiles).empty());
  EXPECT_TRUE(unusable_joysticks(bus, profiles).empty());
  const auto left = std::make_shared<EmulatedVectorJoystick>("LEFT");
  const auto right = std::make_shared<EmulatedVectorJoystick>("RIGHT");
  const auto nameless = std::make_shared<EmulatedPidJoystick>("");
  bus.attach(left);
  bus.attach(right);
  const std::string port = bus.attach(nameless);
  bus.forbid(bus.attach(std::make_shared<EmulatedPidJoystick>("SHUT")));
  const auto infos = list_joysticks(bus, profiles);
  ASSERT_EQ(infos.size(), 3u);
  const auto reasons = unusable_joysticks(bus, profiles);
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_NE(reasons[0].find("permission"), std::string::npos);
  for (const DeviceInfo& info : infos) {
    auto device = open_joystick(bus, profiles, info);
    ASSERT_TRUE(device) << info.serial << ": " << device.error().message();
    EXPECT_EQ((*device)->info().serial, info.serial);
    EXPECT_FALSE(open_joystick(bus, profiles, info));  // held by another
    for (int i = 0; i < 10; ++i) {
      bus.advance(kMs);
      (*device)->read();
      (*device)->write_force(Vec3(1, 0, 0));
    }
    EXPECT_EQ(left->mechanics().motors().x() > 0.9, info.serial == "LEFT");
    EXPECT_EQ(right->mechanics().motors().x() > 0.9, info.serial == "RIGHT");
    EXPECT_EQ(nameless->mechanics().motors().x() > 0.9, info.serial == port);
  }
  DeviceInfo gone = infos.front();
  gone.serial = "nobody";
  EXPECT_FALSE(open_joystick(bus, profiles, gone));
}

TEST(JoystickProfile, RefusesAndNamesEveryBrokenKey) {
  const auto source = read_file(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets" / "devices" /
                                "joystick_pid.toml");
  ASSERT_TRUE(source);
  const struct {
    const char* from;
    const char* to;
    const char* named;
  } cases[] = {
      {"dialect = \"pid\"", "dialect = \"xinput\"", "'dialect'"},
      {"dialect = \"pid\"", "dialect = \"vector\"", "unknown key"},
      {"firmware_timeout_ms = 20", "", "'firmware_timeout_ms'"},
      {"firmware_timeout_ms = 20", "firmware_timeout_ms = -1", "'firmware_timeout_ms'"},
      {"dead_man_button = -1", "dead_man_button = 32", "'dead_man_button'"},
      {"dead_man_button = -1", "dead_man_button = 1.5", "'dead_man_button'"},
      {"full_scale_n = 10", "full_scale_n = 1", "'full_scale_n'"},
      {"vendor = 0x1209", "vendor = 0x12090", "'vendor'"},
      {"in_endpoint = 0x81", "in_endpoint = 0x01", "'in_endpoint'"},
      {"out_endpoint = 0x02", "out_endpoint = 0x82", "'out_endpoint'"},
      {"in_bytes = 64", "in_bytes = 64\ncolour = 1", "'colour'"},
      {"x = {usage = \"X\"", "x = {usage = \"W\"", "'usage'"},
      {"sign = -1", "sign = 0", "'sign'"},
      {"half_range_mm = 60", "half_range_mm = 0", "'half_range_mm'"},
      {"[joystick.rotation]", "[joystick.turn]", "'turn'"},
      {"about = \"z\"", "about = \"w\"", "'about'"},
      {"driver = \"joystick\"", "driver = \"mouse\"", "'joystick'"},
  };
  const auto path = std::filesystem::path(::testing::TempDir()) /
                    ("osteon_joystick_" + std::to_string(::getpid()) + ".toml");
  for (const auto& c : cases) {
    std::string text = *source;
    const auto at = text.find(c.from);
    ASSERT_NE(at, std::string::npos) << c.from;
    ASSERT_TRUE(write_file_atomic(path, text.replace(at, std::string(c.from).size(), c.to)));
    const auto info = load_device_profile(path);
    ASSERT_FALSE(info) << c.to;
    EXPECT_NE(info.error().what.find(c.named), std::string::npos)
        << c.to << " -> " << info.error().message();
    EXPECT_FALSE(load_joystick_profile(path)) << c.to;
  }
  std::filesystem::remove(path);
}

TEST(VelocityEstimator, IsExactOnALineAndBoundedByItsStepInNoise) {
  constexpr double kStep = 1e-5;
  VelocityEstimator exact(0);
  VelocityEstimator coarse(kStep);
  Random random(9);
  double worst = 0;
  for (int n = 0; n < 500; ++n) {
    const double x = 0.05 * 1e-3 * n;
    const Vec3 p(x, 0, 0);
    const Vec3 v = exact.add(n * kMs, p);
    ASSERT_NEAR(v.x(), n > 0 ? 0.05 : 0, 1e-9);
    const Vec3 steps(std::round(x / kStep) * kStep, kStep * std::floor(random.uniform(0, 2)), 0);
    const Vec3 u = coarse.add(n * kMs, steps);
    if (n > 20) worst = std::max({worst, std::abs(u.x() - 0.05), std::abs(u.y())});
  }
  // Over the longest window a step of noise is a step in 15 ticks.
  EXPECT_LT(worst, 1.1 * kStep / 0.015);
  EXPECT_GT(worst, 0);
}

TEST(VelocityEstimator, TimeThatStandsStillOrGoesBackChangesNothing) {
  VelocityEstimator estimator(0);
  estimator.add(0, Vec3::Zero());
  const Vec3 v = estimator.add(kMs, Vec3(1e-4, 0, 0));
  EXPECT_NEAR(v.x(), 0.1, 1e-12);
  EXPECT_EQ(estimator.add(kMs, Vec3(5, 5, 5)), v);
  EXPECT_EQ(estimator.add(0, Vec3(5, 5, 5)), v);
  estimator.reset();
  EXPECT_EQ(estimator.add(2 * kMs, Vec3(1, 1, 1)), Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace osteon
