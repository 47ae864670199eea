// The joystick through the real libusb, against a device that umockdev plays. Run it under
// umockdev-wrapper.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <ostream>
#include <thread>

#include "emulated/emulated_pid_joystick.h"
#include "emulated/emulated_vector_joystick.h"
#include "joystick/joystick_driver.h"
#include "osteon/base/clock.h"
#include "umockdev/answer_until.h"
#include "umockdev/mock_usb.h"
#include "usb/libusb_bus.h"

namespace osteon {
namespace {

using testing::MockUsb;

struct TestbedUnref {
  void operator()(UMockdevTestbed* testbed) const { g_object_unref(testbed); }
};

struct Kind {
  const char* name;
  JoystickDialectKind dialect;
  UsbSpeed speed = UsbSpeed::kFull;
  bool out_endpoint = true;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

// A joystick on the mocked bus.
struct MockJoystick {
  MockJoystick(UMockdevTestbed* testbed, const Kind& kind, int number, const std::string& serial) {
    JoystickDescriptors descriptors;
    if (kind.dialect == JoystickDialectKind::kPid) {
      auto device = std::make_shared<EmulatedPidJoystick>(serial, kind.speed);
      if (!kind.out_endpoint) device->leave_out_endpoint_away();
      mechanics = &device->mechanics();
      emulated = device;
      descriptors = pid_joystick_descriptors(kind.out_endpoint);
    } else {
      auto device = std::make_shared<EmulatedVectorJoystick>(serial);
      mechanics = &device->mechanics();
      emulated = device;
      descriptors = vector_joystick_descriptors();
    }
    usb = std::make_unique<MockUsb>(testbed, emulated, descriptors, number);
  }
  Vec3 motors() {
    return usb->locked([&] { return mechanics->motors(); });
  }
  void want(const Vec3& p_V) {
    Pose wanted;
    wanted.p = p_V;
    mechanics->set_target(wanted, Vec3::Zero(), 1);
  }

  std::shared_ptr<EmulatedUsbDevice> emulated;
  JoystickMechanics* mechanics = nullptr;
  std::unique_ptr<MockUsb> usb;
};

class JoystickUmockdev : public ::testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    const char* preloaded = std::getenv("LD_PRELOAD");
    if (!preloaded || !std::strstr(preloaded, "umockdev"))
      GTEST_SKIP() << "run this under umockdev-wrapper";
    testbed.reset(umockdev_testbed_new());
    ASSERT_TRUE(testbed);
    profiles = load_joystick_profiles(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/devices");
    joystick = std::make_unique<MockJoystick>(testbed.get(), GetParam(), 2, "A1");
  }

  std::unique_ptr<UsbBus> bus() {
    auto opened = open_libusb_bus();
    EXPECT_TRUE(opened) << opened.error().message();
    return std::move(*opened);
  }
  std::vector<DeviceInfo> listed() { return list_joysticks(*bus(), profiles); }
  std::unique_ptr<HapticDevice> open(const DeviceInfo& info) {
    auto device = open_joystick(*bus(), profiles, info);
    EXPECT_TRUE(device) << device.error().message();
    return device ? std::move(*device) : nullptr;
  }
  std::unique_ptr<HapticDevice> open_first() {
    const auto infos = listed();
    EXPECT_EQ(infos.size(), 1u);
    return infos.empty() ? nullptr : open(infos.front());
  }
  // Answers readings with this force until `done`; false: not within some seconds.
  template <class Done>
  bool run_until(HapticDevice& device, const Vec3& force_V, Done done) {
    return testing::answer_until(device, force_V, 5, sample, done);
  }
  void run(HapticDevice& device, int ticks, const Vec3& force_V) {
    int left = ticks;
    EXPECT_TRUE(run_until(device, force_V, [&] { return left-- <= 0; }));
  }
  bool motors_reach(HapticDevice& device, MockJoystick& j, const Vec3& sent_V, const Vec3& at_V) {
    return run_until(device, sent_V, [&] { return (j.motors() - at_V).norm() < 2e-3; });
  }

  std::unique_ptr<UMockdevTestbed, TestbedUnref> testbed;
  JoystickProfiles profiles;
  std::unique_ptr<MockJoystick> joystick;
  DeviceSample sample;
};

TEST_P(JoystickUmockdev, IsFoundOpenedReadAndDriven) {
  EXPECT_TRUE(listed().empty());
  joystick->usb->plug();
  const auto infos = listed();
  ASSERT_EQ(infos.size(), 1u);
  EXPECT_EQ(infos[0].serial, "A1");
  EXPECT_EQ(infos[0].driver, "joystick");
  EXPECT_TRUE(unusable_joysticks(*bus(), profiles).empty());
  joystick->want(Vec3(0.010, -0.005, 0.002));
  auto device = open(infos[0]);
  ASSERT_TRUE(device);
  run(*device, 300, Vec3::Zero());
  EXPECT_LT((sample.X_VD.p - Vec3(0.010, -0.005, 0.002)).norm(), 1e-5) << sample.X_VD.p.transpose();
  EXPECT_EQ(sample.buttons, 1u);
  EXPECT_TRUE(sample.connected);
  const Vec3 force(1, -2, 3);
  EXPECT_TRUE(motors_reach(*device, *joystick, force, force)) << joystick->motors().transpose();
  // The grip of 500 N/m yields.
  const Vec3 yielded(0.012, -0.009, 0.008);
  EXPECT_TRUE(run_until(*device, force, [&] { return (sample.X_VD.p - yielded).norm() < 1e-4; }))
      << sample.X_VD.p.transpose();
  EXPECT_GT(device->health().reports_in, 300u);
  EXPECT_EQ(device->health().bad_reports, 0u);
  device->close();
  EXPECT_EQ(joystick->motors(), Vec3(Vec3::Zero()));
  EXPECT_EQ(joystick->usb->in_flight(), 0u);
}

TEST_P(JoystickUmockdev, UnplugIsNoticedAndAReplugIsOpenedAnew) {
  joystick->usb->plug();
  auto device = open_first();
  ASSERT_TRUE(device);
  const Vec3 force(2, 0, 0);
  EXPECT_TRUE(motors_reach(*device, *joystick, force, force));
  joystick->usb->unplug();
  run(*device, 3, force);
  EXPECT_FALSE(sample.connected);
  EXPECT_TRUE(listed().empty());
  // Its own power goes on, and so does its time-out.
  joystick->usb->locked([&] { joystick->usb->pass_frames(20); });
  EXPECT_EQ(joystick->motors(), Vec3(Vec3::Zero()));
  joystick->usb->plug();
  run(*device, 100, force);
  EXPECT_FALSE(sample.connected);
  EXPECT_EQ(joystick->motors(), Vec3(Vec3::Zero()));
  device->close();
  device = open_first();
  ASSERT_TRUE(device);
  EXPECT_TRUE(motors_reach(*device, *joystick, force, force));
  EXPECT_TRUE(sample.connected);
}

TEST_P(JoystickUmockdev, HotplugIsCounted) {
  const auto watched = bus();
  joystick->usb->plug();
  const auto soon = [&](auto done) {
    const std::int64_t end_ns = steady_now_ns() + 5'000'000'000;
    while (!done(watched->changes()) && steady_now_ns() < end_ns) std::this_thread::yield();
    return done(watched->changes());
  };
  EXPECT_TRUE(soon([](const UsbChanges& c) { return c.arrived == 1; }));
  EXPECT_EQ(watched->list(0x1209, 0).size(), 1u);
  joystick->usb->unplug();
  EXPECT_TRUE(soon([](const UsbChanges& c) { return c.left == 1; }));
}

TEST_P(JoystickUmockdev, AStallEndsTheForceUntilTheUserRestartsIt) {
  joystick->usb->plug();
  auto device = open_first();
  ASSERT_TRUE(device);
  const Vec3 force(2, 0, 0);
  EXPECT_TRUE(motors_reach(*device, *joystick, force, force));
  joystick->usb->set_stall_in(true);
  run(*device, 10, force);
  EXPECT_EQ(sample.refusal, ForceOff::kDeviceFault);
  EXPECT_EQ(joystick->motors(), Vec3(Vec3::Zero()));
  device->calibrate();
  EXPECT_TRUE(motors_reach(*device, *joystick, force, force));
  EXPECT_EQ(sample.refusal, ForceOff::kNone);
}

TEST_P(JoystickUmockdev, ASilentDeviceGetsTheLastForceAndNoOther) {
  joystick->usb->plug();
  auto device = open_first();
  ASSERT_TRUE(device);
  EXPECT_TRUE(motors_reach(*device, *joystick, Vec3(2, 0, 0), Vec3(2, 0, 0)));
  joystick->usb->set_silent(true);
  const DeviceHealth before = device->health();
  const Vec3 newer(3, 0, 0);
  EXPECT_TRUE(run_until(*device, newer, [&] { return sample.refusal == ForceOff::kDisconnect; }));
  run(*device, 100, newer);
  EXPECT_EQ(joystick->motors(), Vec3(Vec3::Zero()));
  const DeviceHealth during = device->health();
  EXPECT_LE(during.reports_out, before.reports_out + 3);  // had been taken but not told
  EXPECT_GT(during.replaced, before.replaced + 50);
  // Two readings and one force (at high speed one of each axis), never a queue.
  EXPECT_LE(joystick->usb->in_flight(), GetParam().speed == UsbSpeed::kHigh ? 5u : 3u);
  joystick->usb->set_silent(false);
  for (int i = 0; i < 10; ++i) {
    run(*device, 1, Vec3::Zero());
    EXPECT_EQ(joystick->motors(), Vec3(Vec3::Zero()));
  }
  EXPECT_TRUE(motors_reach(*device, *joystick, Vec3(1, 0, 0), Vec3(1, 0, 0)));
}

TEST_P(JoystickUmockdev, OneThatCannotBeOpenedIsNamedWithItsReason) {
  joystick->usb->plug(false);
  EXPECT_TRUE(listed().empty());
  const auto reasons = unusable_joysticks(*bus(), profiles);
  ASSERT_EQ(reasons.size(), 1u);
  EXPECT_NE(reasons[0].find("1209:000"), std::string::npos) << reasons[0];
}

TEST_P(JoystickUmockdev, TwoOfThemByTheirSerialNumbers) {
  MockJoystick other(testbed.get(), GetParam(), 3, "B2");
  joystick->usb->plug();
  other.usb->plug();
  const auto infos = listed();
  ASSERT_EQ(infos.size(), 2u);
  const Vec3 force(1.5, 0, 0);
  for (const DeviceInfo& info : infos) {
    auto device = open(info);
    ASSERT_TRUE(device);
    EXPECT_TRUE(motors_reach(*device, info.serial == "A1" ? *joystick : other, force, force));
    EXPECT_EQ((info.serial == "A1" ? other : *joystick).motors(), Vec3(Vec3::Zero()));
    device->close();
  }
  // Each on a thread of its own.
  auto left = open(infos[0]);
  auto right = open(infos[1]);
  ASSERT_TRUE(left && right);
  const auto drive = [&](HapticDevice& device, MockJoystick& of) {
    for (int i = 0; i < 10000 && (of.motors() - force).norm() > 2e-3; ++i) {
      device.read();
      device.write_force(force);
    }
  };
  MockJoystick& of_left = infos[0].serial == "A1" ? *joystick : other;
  MockJoystick& of_right = infos[0].serial == "A1" ? other : *joystick;
  std::thread first([&] { drive(*left, of_left); });
  drive(*right, of_right);
  first.join();
  EXPECT_LT((of_left.motors() - force).norm(), 2e-3);
  EXPECT_LT((of_right.motors() - force).norm(), 2e-3);
}

// The newest force of an axis is on its way a tick after it was written, each axis in its turn.
TEST_P(JoystickUmockdev, AForceIsThereAfterThreeTicksAtTheLatest) {
  joystick->usb->plug();
  auto device = open_first();
  ASSERT_TRUE(device);
  EXPECT_TRUE(motors_reach(*device, *joystick, Vec3(1, 1, 1), Vec3(1, 1, 1)));
  run(*device, 20, Vec3(1, 1, 1));
  int ticks = 0;
  const Vec3 newer(2, -3, 4);
  for (; ticks < 50 && (joystick->motors() - newer).norm() > 2e-3; ++ticks) run(*device, 1, newer);
  // `run` polls twice; a poll is a frame at least.
  EXPECT_LE(ticks, GetParam().speed == UsbSpeed::kHigh ? 4 : 5);
}

INSTANTIATE_TEST_SUITE_P(
    , JoystickUmockdev,
    ::testing::Values(Kind{"Pid", JoystickDialectKind::kPid},
                      Kind{"PidHighSpeed", JoystickDialectKind::kPid, UsbSpeed::kHigh},
                      Kind{"PidByControl", JoystickDialectKind::kPid, UsbSpeed::kFull, false},
                      Kind{"Vector", JoystickDialectKind::kVector}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace osteon
