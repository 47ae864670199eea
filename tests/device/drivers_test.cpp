#include "osteon/device/drivers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "osteon/device/mouse_device.h"
#include "osteon/device/pad_device.h"
#include "osteon/device/virtual_device.h"

namespace osteon {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

DeviceInfo test_info() {
  DeviceInfo info;
  info.workspace_m = Vec3(0.2, 0.2, 0.2);
  info.peak_force_n = 8;
  return info;
}

TEST(Drivers, EachListsDevicesThatItOpens) {
  std::set<std::string> names;
  for (const Driver& driver : drivers()) {
    EXPECT_TRUE(names.insert(driver.name).second) << driver.name;
    const auto devices = driver.list();
    ASSERT_TRUE(devices) << devices.error().message();
    for (const DeviceInfo& info : *devices) {
      EXPECT_EQ(info.driver, driver.name);
      const auto device = driver.open(info);
      ASSERT_TRUE(device) << device.error().message();
      EXPECT_EQ((*device)->info().name, info.name);
      const DeviceSample sample = (*device)->read();
      EXPECT_TRUE(sample.connected);
      EXPECT_TRUE(is_finite(sample.X_VD));
      (*device)->write_force(Vec3(kNan, 0, 0));
      EXPECT_TRUE(is_finite((*device)->read().X_VD));
      (*device)->close();
      (*device)->close();
      EXPECT_FALSE((*device)->read().connected);
    }
  }
  EXPECT_EQ(names, (std::set<std::string>{"falcon", "gamepad", "joystick", "mouse", "null",
                                          "phantom", "virtual", "virtual-usb-pid",
                                          "virtual-usb-torque", "virtual-usb-vector"}));
}

TEST(Drivers, AnUnknownNameListsTheKnownOnes) {
  const auto device = open_device("hawk");
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().todo.find("mouse"), std::string::npos);
  EXPECT_TRUE(open_device("virtual"));
}

TEST(Drivers, MouseAndGamepadHaveNoForceAxes) {
  for (const char* name : {"mouse", "gamepad"}) {
    const auto device = open_device(name);
    ASSERT_TRUE(device);
    EXPECT_EQ((*device)->info().force_axes, (std::array<bool, 3>{false, false, false}));
  }
}

TEST(MouseDevice, ReachesTheTargetSmoothlyWithoutOvershoot) {
  MouseDevice mouse(test_info(), 0.020);
  Pose wanted;
  wanted.p = Vec3(0.05, 0, 0);
  wanted.q = Quat(Eigen::AngleAxisd(1.0, Vec3::UnitY()));
  mouse.set_target(wanted, 5);
  double last_x = 0;
  double last_angle = 1;
  for (int i = 0; i < 1000; ++i) {
    const DeviceSample s = mouse.read();
    ASSERT_EQ(s.time_ns, (i + 1) * 1000000);
    ASSERT_EQ(s.buttons, 5u);
    ASSERT_GE(s.X_VD.p.x(), last_x - 1e-15);
    ASSERT_LE(s.X_VD.p.x(), 0.05 + 1e-12);
    ASSERT_NEAR(s.v_V.x(), (s.X_VD.p.x() - last_x) / 0.001, 1e-9);
    ASSERT_LT(s.X_VD.p.x() - last_x, 0.05 * 0.001 / 0.020);  // no jump
    const double angle = s.X_VD.q.angularDistance(wanted.q);
    ASSERT_LE(angle, last_angle + 1e-7);
    last_x = s.X_VD.p.x();
    last_angle = angle;
  }
  EXPECT_NEAR(last_x, 0.05, 1e-9);
  EXPECT_LT(last_angle, 1e-6);
}

TEST(MouseDevice, IgnoresATargetThatIsNotFinite) {
  MouseDevice mouse(test_info());
  Pose bad;
  bad.p.y() = kNan;
  mouse.set_target(bad, 1);
  for (int i = 0; i < 10; ++i) {
    const DeviceSample s = mouse.read();
    EXPECT_EQ(s.X_VD.p, Vec3(Vec3::Zero()));
    EXPECT_EQ(s.buttons, 0u);
  }
}

TEST(PadDevice, IntegratesTheSticksWithADeadZoneInsideTheWorkspace) {
  PadDevice pad(test_info());
  PadAxes axes;
  axes.move_V = Vec3(1, 0.1, kNan);  // full, within the dead zone, broken
  axes.turn_V = Vec3(0, 1, 0);
  axes.buttons = 2;
  pad.set_axes(axes);
  DeviceSample s;
  for (int i = 0; i < 1000; ++i) s = pad.read();
  EXPECT_NEAR(s.X_VD.p.x(), 0.05, 1e-9);  // 50 mm/s for a second
  EXPECT_EQ(s.X_VD.p.y(), 0);
  EXPECT_EQ(s.X_VD.p.z(), 0);
  EXPECT_NEAR(s.v_V.x(), 0.05, 1e-9);
  EXPECT_NEAR(s.X_VD.q.angularDistance(Quat(Eigen::AngleAxisd(1.5, Vec3::UnitY()))), 0, 1e-4);
  EXPECT_EQ(s.buttons, 2u);
  for (int i = 0; i < 3000; ++i) s = pad.read();
  EXPECT_NEAR(s.X_VD.p.x(), 0.1, 1e-12);  // the wall of the workspace
  EXPECT_EQ(s.v_V.x(), 0);
  axes.connected = false;
  pad.set_axes(axes);
  EXPECT_FALSE(pad.read().connected);
}

TEST(VirtualDevice, FollowsItsTargetAndYieldsToDrivenAxesOnly) {
  DeviceInfo info = test_info();
  info.force_axes = {true, false, true};
  VirtualDevice device(info, HandParams{0.15, 500, 12});
  Pose wanted;
  wanted.p = Vec3(0.01, 0.02, 0.03);
  device.set_target(wanted, Vec3::Zero(), 1);
  DeviceSample s;
  for (int i = 0; i < 3000; ++i) {
    device.write_force(Vec3(-1, -1, 0));
    s = device.read();
  }
  EXPECT_LT((s.X_VD.p - Vec3(0.01 - 1.0 / 500, 0.02, 0.03)).norm(), 1e-9);
  EXPECT_EQ(s.time_ns, 3000ll * 1000000);
  EXPECT_EQ(s.buttons, 1u);
  device.close();
  EXPECT_FALSE(device.read().connected);
}

}  // namespace
}  // namespace osteon
