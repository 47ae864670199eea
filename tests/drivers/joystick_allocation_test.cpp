#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "count_allocations.h"
#include "emulated/joystick_mechanics.h"
#include "emulated/virtual_usb.h"

namespace osteon {
namespace {

using testing::allocations;

// Reads and writes of a joystick, sound and at fault, the emulated bus and device included.
void expect_no_allocation(const char* file) {
  const auto profile =
      load_joystick_profile(std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/devices" / file);
  ASSERT_TRUE(profile) << profile.error().message();
  auto joystick = VirtualUsbJoystick::open(*profile);
  ASSERT_TRUE(joystick) << joystick.error().message();
  UsbFaults& faults = (*joystick)->bus().faults((*joystick)->port());
  const std::uint64_t before = allocations();
  for (int i = 0; i < 2000; ++i) {
    Pose wanted;
    wanted.p = Vec3(1e-5 * i, 0, 0);
    (*joystick)->set_target(wanted, Vec3::Zero(), 0);
    const DeviceSample sample = (*joystick)->read();
    (*joystick)->write_force(Vec3(1, 2, 3) * (sample.connected ? 1 : 0));
    if (i == 500) faults.garbage_in = 20;
    if (i == 700) faults.silent_until_ns = (*joystick)->bus().now_ns() + 50'000'000;
    if (i == 1000) faults.stall_in = true;
    if (i == 1200) (*joystick)->calibrate();
    if (i == 1800) (*joystick)->write_force(Vec3::Constant(std::nan("")));
    ASSERT_EQ(allocations(), before) << i;
  }
  EXPECT_NE((*joystick)->mechanics().motors(), Vec3(Vec3::Zero()));
}

TEST(NoAllocation, InAPidJoysticksTick) { expect_no_allocation("joystick_pid.toml"); }
TEST(NoAllocation, InAVectorJoysticksTick) { expect_no_allocation("joystick_vector.toml"); }

}  // namespace
}  // namespace osteon
