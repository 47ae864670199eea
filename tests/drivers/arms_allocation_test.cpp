// Counts what a tick of each driver takes from the heap: nothing, in health and in trouble.
#include <gtest/gtest.h>

#include "count_allocations.h"
#include "device/falcon/falcon_rig.h"
#include "device/phantom/stub_library.h"

namespace osteon {
namespace {

// What read and write_force take; the emulation's own between them does not count.
std::uint64_t taken_by_a_tick(HapticDevice& device, const Vec3& force_V) {
  const std::uint64_t before = testing::allocations();
  (void)device.read();
  device.write_force(force_V);
  (void)device.health();
  return testing::allocations() - before;
}

TEST(ArmsAllocation, InATickOfAPhantomArm) {
  testing::StubLibrary stub;
  const auto arm = PhantomDevice::open(stub.session(), "Left Device").value();
  for (int n = 0; n < 2000; ++n) {
    if (n == 500) stub.left->raise = hd::kExceededMaxVelocity;
    if (n == 800) stub.left->garbage = 2;
    if (n == 1000) stub.left->garbage = 0;
    if (n == 1200) stub.left->calibration = hd::kCalibrationNeedsManualInput;
    if (n == 1500) stub.left->plugged = false;
    stub.step(1);
    ASSERT_EQ(taken_by_a_tick(*arm, Vec3(0, 0.001 * (n % 500), 0)), 0u) << n;
  }
}

TEST(ArmsAllocation, InATickOfAFalcon) {
  testing::FalconRig rig;
  const auto device = rig.open();
  rig.home(*device);
  for (int n = 0; n < 2000; ++n) {
    UsbFaults& faults = rig.bus.faults(rig.port);
    if (n == 300) faults.garbage_in = 50;
    if (n == 600) faults.stall_out = true;
    if (n == 800) faults.stall_in = true;
    if (n == 1000) faults.silent_until_ns = rig.bus.now_ns() + 50'000'000;
    if (n == 1300) rig.falcon->nonsense = true;
    if (n == 1500) rig.bus.detach(rig.port);
    rig.step();
    ASSERT_EQ(taken_by_a_tick(*device, Vec3(0, 0.001 * (n % 500), 0)), 0u) << n;
  }
}

}  // namespace
}  // namespace osteon
