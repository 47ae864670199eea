#include "phantom/phantom_device.h"
#include "osteon/device/inkwell.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "device/phantom/stub_library.h"
#include "device/wall_loop.h"

namespace osteon {
namespace {

using testing::motor_force;
using testing::StubLibrary;
using testing::want;

// The stub's usable workspace is (-180, -50, -90) to (180, 150, 30) mm.
const Vec3 kCentre_mm(0, 50, -30);

std::unique_ptr<HapticDevice> open(const std::shared_ptr<HdSession>& session, const char* name) {
  auto device = PhantomDevice::open(session, name);
  EXPECT_TRUE(device) << device.error().message();
  return device ? std::move(*device) : nullptr;
}

TEST(PhantomDevice, TellsPoseAndVelocityInItsOwnFrame) {
  StubLibrary stub;
  want(*stub.left, kCentre_mm + Vec3(10, 20, 30));
  const double h = std::sqrt(0.5);
  stub.left->wanted_q[0] = stub.left->wanted_q[2] = h;  // a quarter turn about y
  const auto arm = open(stub.session(), "Left Device");
  stub.left->buttons = 2;
  stub.left->speed = 250;
  stub.step(3);
  const DeviceSample s = arm->read();
  EXPECT_EQ(s.time_ns, 3'000'000);
  EXPECT_LT((s.X_VD.p - Vec3(0.010, 0.020, 0.030)).norm(), 1e-12);
  EXPECT_LT((s.X_VD.q * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((s.v_V - Vec3(0.25, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(s.buttons, 2u);
  EXPECT_TRUE(s.connected && s.calibrated && s.dead_man_held);
  EXPECT_EQ(s.refusal, ForceOff::kNone);
  EXPECT_LT((arm->info().workspace_m - Vec3(0.36, 0.2, 0.12)).norm(), 1e-12);
}

TEST(PhantomDevice, TellsTheInkwellWhereTheArmHasOne) {
  for (const bool has_one : {true, false}) {
    StubLibrary stub;
    if (!has_one) stub.left->calibration_style = hd::kStyleAuto;
    const auto arm = open(stub.session(), "Left Device");
    stub.left->buttons = 1;
    stub.step(3);
    EXPECT_EQ(arm->read().buttons, 1u);
    stub.left->inkwell = true;
    stub.step(3);
    EXPECT_EQ(arm->read().buttons, has_one ? 1u | 1u << kInkwellButton : 1u);
  }
}

TEST(PhantomDevice, PutsOutTheForceAndNeverMoreThanItsLimit) {
  StubLibrary stub;
  const auto arm = open(stub.session(), "Left Device");
  stub.step(1);
  arm->write_force(Vec3(1, -2, 0.5));
  stub.step(1);
  EXPECT_EQ(motor_force(*stub.left), Vec3(1, -2, 0.5));
  arm->write_force(Vec3(0, -30, 40));
  stub.step(1);
  EXPECT_LT((motor_force(*stub.left) - 7.9 * Vec3(0, -0.6, 0.8)).norm(), 1e-12);
  arm->write_force(Vec3(std::nan(""), 1, 1));
  stub.step(1);
  EXPECT_EQ(motor_force(*stub.left), Vec3(0, 0, 0));
}

TEST(PhantomDevice, AnArmThatReportsLessIsHeldToLess) {
  StubLibrary stub;
  stub.left->model = "Touch";
  stub.left->max_force_n = 2.5;
  stub.left->max_stiffness_n_per_mm = 0.5;
  const auto weak = open(stub.session(), "Left Device");
  EXPECT_EQ(weak->info().peak_force_n, 2.5);
  EXPECT_EQ(weak->info().continuous_force_n, 0.88);
  EXPECT_EQ(weak->info().max_stiffness_n_per_m, 500);
  EXPECT_FALSE(weak->info().has_dead_man);

  stub.right->quiet = true;
  const auto quiet = open(stub.session(), "Right Device");
  EXPECT_EQ(quiet->info().peak_force_n, 3.3);
  EXPECT_EQ(quiet->info().serial, "Right Device");
}

TEST(PhantomDevice, TwoArmsAtOnceFeelEachItsOwnForce) {
  StubLibrary stub;
  const auto session = stub.session();
  const auto left = open(session, "Left Device");
  const auto right = open(session, "Right Device");
  want(*stub.right, Vec3(0, 0, 0));
  stub.step(2);
  left->write_force(Vec3(1, 0, 0));
  right->write_force(Vec3(0, -1, 0));
  stub.step(1);
  EXPECT_EQ(motor_force(*stub.left), Vec3(1, 0, 0));
  EXPECT_EQ(motor_force(*stub.right), Vec3(0, -1, 0));
  // One goes, the other stays and works on.
  left->close();
  EXPECT_EQ(motor_force(*stub.left), Vec3(0, 0, 0));
  EXPECT_FALSE(left->read().connected);
  right->write_force(Vec3(0, -2, 0));
  stub.step(1);
  EXPECT_EQ(motor_force(*stub.right), Vec3(0, -2, 0));
  EXPECT_TRUE(right->read().connected);
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST(PhantomDevice, OpeningFailsInWords) {
  StubLibrary stub;
  const auto session = stub.session();
  const auto message = [&](const char* name) {
    auto device = PhantomDevice::open(session, name);
    return device ? std::string("opened") : device.error().message();
  };
  stub.left->refuse_init = hd::kInvalidLicense;
  EXPECT_NE(message("Left Device").find("no valid licence"), std::string::npos);
  EXPECT_NE(message("Left Device").find("Invalid license"), std::string::npos);
  stub.left->refuse_init = 0;
  stub.left->plugged = false;
  EXPECT_NE(message("Left Device").find("check its cable"), std::string::npos);
  stub.left->plugged = true;
  EXPECT_NE(message("Third Arm").find("Third Arm"), std::string::npos);

  // One that fails leaves the other running.
  const auto right = open(session, "Right Device");
  stub.left->refuse_init = hd::kDeviceFault;
  EXPECT_NE(message("Left Device"), "opened");
  EXPECT_TRUE(stub.scheduler_runs());
  right->write_force(Vec3(0, 0, 1));
  stub.step(1);
  EXPECT_EQ(motor_force(*stub.right), Vec3(0, 0, 1));
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST(PhantomDevice, AsksForTheInkwellAndForceComesOnlyAfterIt) {
  StubLibrary stub;
  stub.left->calibration = hd::kCalibrationNeedsManualInput;
  const auto arm = open(stub.session(), "Left Device");
  const auto order_for = [&](int ms) {
    for (int i = 0; i < ms; ++i) {
      arm->write_force(Vec3(1, 0, 0));
      stub.step(1);
    }
  };
  order_for(15);
  EXPECT_FALSE(arm->read().calibrated);
  EXPECT_EQ(arm->health().calibration, Calibration::kNeeded);
  EXPECT_STREQ(arm->health().advice, "Put the stylus into the inkwell");
  EXPECT_EQ(stub.left->peak_motor_n, 0);
  EXPECT_EQ(stub.left->updates, 0u);

  stub.left->calibration = hd::kCalibrationNeedsUpdate;  // now it is in
  order_for(11);
  EXPECT_EQ(stub.left->updates, 1u);
  EXPECT_TRUE(arm->read().calibrated);
  EXPECT_EQ(arm->health().calibration, Calibration::kDone);
  EXPECT_STREQ(arm->health().advice, "");
  order_for(1);
  EXPECT_EQ(motor_force(*stub.left), Vec3(1, 0, 0));
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST(PhantomDevice, EncodersAreResetByTheUsersWishAlone) {
  StubLibrary stub;
  stub.left->calibration_style = hd::kStyleEncoderReset;
  stub.left->calibration = hd::kCalibrationNeedsManualInput;
  const auto arm = open(stub.session(), "Left Device");
  stub.step(100);
  (void)arm->read();
  EXPECT_EQ(stub.left->updates, 0u);
  EXPECT_NE(std::string(arm->health().advice).find("reset position"), std::string::npos);
  arm->calibrate();
  stub.step(11);
  EXPECT_EQ(stub.left->updates, 1u);
  EXPECT_TRUE(arm->read().calibrated);
  stub.step(100);
  EXPECT_EQ(stub.left->updates, 1u);  // one wish, one reset
}

TEST(PhantomDevice, CalibratingAnewStopsTheForceFirst) {
  StubLibrary stub;
  stub.left->calibration_style = hd::kStyleAuto;
  const auto arm = open(stub.session(), "Left Device");
  stub.step(1);
  for (int i = 0; i < 5; ++i) {
    arm->write_force(Vec3(2, 0, 0));
    stub.step(1);
  }
  EXPECT_EQ(motor_force(*stub.left), Vec3(2, 0, 0));
  arm->calibrate();
  bool seen_off = false;
  for (int i = 0; i < 25; ++i) {
    arm->write_force(Vec3(2, 0, 0));
    stub.step(1);
    seen_off = seen_off || !arm->read().calibrated;
  }
  EXPECT_TRUE(seen_off);
  EXPECT_EQ(stub.left->updates, 1u);
  EXPECT_EQ(stub.misuses(), 0u);  // the stub counts a calibration under force
}

TEST(PhantomDevice, CountsWhatCameAndWent) {
  StubLibrary stub;
  const auto arm = open(stub.session(), "Left Device");
  stub.step(10);
  arm->write_force(Vec3(1, 0, 0));
  arm->write_force(Vec3(2, 0, 0));
  arm->write_force(Vec3(3, 0, 0));  // the last one wins
  stub.step(1);
  EXPECT_EQ(motor_force(*stub.left), Vec3(3, 0, 0));
  (void)arm->read();
  EXPECT_EQ(arm->health().reports_in, 11u);
  EXPECT_EQ(arm->health().reports_out, 11u);
  EXPECT_EQ(arm->health().replaced, 2u);
  EXPECT_EQ(arm->health().bad_reports, 0u);
}

// The library's servo thread, a thread for each arm, and a user who opens and closes one of them.
TEST(PhantomDevice, ServoLoopAndTwoHandsRunAtOnce) {
  StubLibrary stub;
  const auto session = stub.session();
  const auto left = open(session, "Left Device");
  std::atomic<bool> over{false};
  std::thread servo([&] {
    while (!over) stub.step(1);
  });
  std::thread hand([&] {
    for (int i = 0; i < 20000; ++i) {
      const DeviceSample s = left->read();
      EXPECT_TRUE(is_finite(s.X_VD));
      left->write_force(Vec3(0, 1e-3 * (i % 1000), 0));
    }
    left->write_force(Vec3::Zero());
  });
  for (int i = 0; i < 20; ++i) {
    const auto right = open(session, "Right Device");
    for (int k = 0; k < 50; ++k) {
      (void)right->read();
      right->write_force(Vec3(1, 0, 0));
    }
  }
  hand.join();
  over = true;
  servo.join();
  EXPECT_EQ(stub.right->inits, 20u);
  EXPECT_EQ(stub.right->disables, 20u);
  EXPECT_TRUE(motor_force(*stub.right).isZero(0));
  EXPECT_EQ(stub.misuses(), 0u);
}

TEST(PhantomDevice, ItsTimeStandsStillUntilTheArmHasSentAnew) {
  StubLibrary stub;
  const auto arm = open(stub.session(), "Left Device");
  stub.step(4);
  const std::int64_t before = arm->read().time_ns;
  stub.stall(7);
  EXPECT_EQ(arm->read().time_ns, before);
  stub.step(1);
  EXPECT_EQ(arm->read().time_ns, before + 8'000'000);
}

}  // namespace
}  // namespace osteon
