// The whole program on a computer where a joystick is plugged in that this user may not open.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "cli/run_osteon.h"
#include "emulated/emulated_vector_joystick.h"
#include "umockdev/mock_usb.h"

namespace osteon {
namespace {

using testing_cli::Ran;

// The child sees the same made-up /sys and /dev: the preloaded library and the test bed's folder
// are in its environment.
Ran run(const std::string& arguments) { return testing_cli::run_osteon(arguments); }

TEST(ProgramUmockdev, WithoutPermissionItNamesTheDeviceAndWorks) {
  const char* preloaded = std::getenv("LD_PRELOAD");
  if (!preloaded || !std::strstr(preloaded, "umockdev"))
    GTEST_SKIP() << "run this under umockdev-wrapper";
  UMockdevTestbed* testbed = umockdev_testbed_new();
  const Ran before = run("devices");
  EXPECT_EQ(before.exit_code, 0) << before.output;
  EXPECT_EQ(before.output.find("1209:0001"), std::string::npos) << before.output;
  {
    testing::MockUsb usb(testbed, std::make_shared<EmulatedVectorJoystick>("A1"),
                         vector_joystick_descriptors(), 2);
    usb.plug(false);
    for (const char* command : {"devices", "doctor --seconds 0.1"}) {
      const Ran ran = run(command);
      EXPECT_NE(ran.output.find("1209:0001"), std::string::npos) << command << "\n" << ran.output;
      EXPECT_NE(ran.output.find("mouse"), std::string::npos) << ran.output;
      EXPECT_TRUE(ran.exit_code == 0 || ran.exit_code == 1) << ran.output;
    }
  }
  g_object_unref(testbed);
}

}  // namespace
}  // namespace osteon
