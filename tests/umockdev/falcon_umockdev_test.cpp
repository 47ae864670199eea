// The Falcon through the real libusb: FTDI requests on the control endpoint, bulk transfers, its
// boot loader and its firmware. Run it under umockdev-wrapper.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

#include "device/falcon/falcon_rig.h"
#include "falcon/falcon_kinematics.h"
#include "osteon/base/clock.h"
#include "umockdev/answer_until.h"
#include "umockdev/mock_usb.h"
#include "usb/libusb_bus.h"

namespace osteon {
namespace {

using testing::EmulatedFalcon;
using testing::MockUsb;

struct TestbedUnref {
  void operator()(UMockdevTestbed* testbed) const { g_object_unref(testbed); }
};

class FalconUmockdev : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* preloaded = std::getenv("LD_PRELOAD");
    if (!preloaded || !std::strstr(preloaded, "umockdev"))
      GTEST_SKIP() << "run this under umockdev-wrapper";
    testbed.reset(umockdev_testbed_new());
    ASSERT_TRUE(testbed);
    falcon = std::make_shared<EmulatedFalcon>(testing::pretended_firmware());
    usb = std::make_unique<MockUsb>(testbed.get(), falcon, testing::falcon_descriptors(), 2);
    auto opened = open_libusb_bus();
    ASSERT_TRUE(opened) << opened.error().message();
    bus = std::move(*opened);
  }

  std::unique_ptr<HapticDevice> open() {
    const auto listed = list_falcons(*bus);
    EXPECT_TRUE(listed && listed->size() == 1) << "no Falcon is listed";
    if (!listed || listed->empty()) return nullptr;
    auto device = open_falcon(*bus, listed->front());
    EXPECT_TRUE(device) << device.error().message();
    return device ? std::move(*device) : nullptr;
  }
  // Looks at the device, with this force, until `done`; false: not within some seconds.
  template <class Done>
  bool run_until(HapticDevice& device, const Vec3& force_V, Done done) {
    return testing::answer_until(device, force_V, 10, sample, done);
  }
  bool lead(HapticDevice& device, const Vec3& to_V) {
    const Vec3 from_V = usb->locked([&] { return falcon->position_V(); });
    for (int i = 1; i <= 200; ++i) {
      usb->locked([&] { falcon->want(from_V + (to_V - from_V) * i / 200); });
      sample = device.read();
    }
    return run_until(device, Vec3::Zero(), [&] {
      return usb->locked([&] { return (falcon->position_V() - to_V).norm() < 1e-3; });
    });
  }
  void home(HapticDevice& device) {
    EXPECT_TRUE(lead(device, Vec3(0, 0, -0.03)));
    EXPECT_TRUE(lead(device, Vec3(0, 0, 0.048)));
    EXPECT_TRUE(lead(device, Vec3::Zero()));
    EXPECT_TRUE(run_until(device, Vec3::Zero(), [&] { return sample.calibrated; }));
  }
  Vec3 motors() {
    return usb->locked([&] { return falcon->motor_force(); });
  }

  testing::FirmwareFile firmware{testing::pretended_firmware()};
  std::unique_ptr<UMockdevTestbed, TestbedUnref> testbed;
  std::shared_ptr<EmulatedFalcon> falcon;
  std::unique_ptr<MockUsb> usb;
  std::unique_ptr<UsbBus> bus;
  DeviceSample sample;
};

TEST_F(FalconUmockdev, IsBroughtUpHomedReadAndDriven) {
  EXPECT_TRUE(list_falcons(*bus)->empty());
  usb->plug();
  const auto device = open();
  ASSERT_TRUE(device);
  EXPECT_EQ(device->info().serial, "FN0001");
  EXPECT_TRUE(falcon->runs());
  EXPECT_EQ(falcon->loaded(), testing::pretended_firmware().size());
  home(*device);
  EXPECT_TRUE(lead(*device, Vec3(0.010, -0.005, 0.004)));
  EXPECT_TRUE(run_until(*device, Vec3::Zero(), [&] {
    return (sample.X_VD.p - Vec3(0.010, -0.005, 0.004)).norm() < 1.5e-3;
  })) << sample.X_VD.p.transpose();
  const Vec3 force(1, -2, 1.5);
  // A step of the motors' counts is felt as some millinewtons.
  EXPECT_TRUE(run_until(*device, force, [&] { return (motors() - force).norm() < 0.02; }))
      << motors().transpose();
  device->close();
  EXPECT_EQ(motors(), Vec3(Vec3::Zero()));
  EXPECT_EQ(usb->in_flight(), 0u);
}

TEST_F(FalconUmockdev, UnpluggedUnderForceItIsNamedAndComesBackHomedOnlyWhenOpened) {
  usb->plug();
  auto device = open();
  ASSERT_TRUE(device);
  home(*device);
  const Vec3 force(0, 0, 2);
  EXPECT_TRUE(run_until(*device, force, [&] { return motors().norm() > 1.9; }));
  usb->unplug();
  EXPECT_TRUE(run_until(*device, force, [&] { return !sample.connected; }));
  EXPECT_EQ(sample.refusal, ForceOff::kDisconnect);
  EXPECT_EQ(motors(), Vec3(Vec3::Zero()));
  usb->plug();
  EXPECT_FALSE(device->read().connected);
  device->close();
  device = open();
  ASSERT_TRUE(device);
  EXPECT_EQ(motors(), Vec3(Vec3::Zero()));
}

TEST_F(FalconUmockdev, AStalledBulkEndpointEndsTheForceAndIsCleared) {
  usb->plug();
  const auto device = open();
  ASSERT_TRUE(device);
  home(*device);
  const Vec3 force(0, 0, 2);
  EXPECT_TRUE(run_until(*device, force, [&] { return motors().norm() > 1.9; }));
  usb->set_stall_in(true);
  EXPECT_TRUE(run_until(*device, force, [&] { return sample.refusal != ForceOff::kNone; }));
  EXPECT_EQ(sample.refusal, ForceOff::kDeviceFault);
  EXPECT_TRUE(run_until(*device, force, [&] { return motors().isZero(0); }));
  // It answers again, and gives force only after an order of none.
  EXPECT_TRUE(run_until(*device, Vec3::Zero(), [&] { return sample.refusal == ForceOff::kNone; }));
  EXPECT_TRUE(run_until(*device, force, [&] { return motors().norm() > 1.9; }));
}

}  // namespace
}  // namespace osteon
