// The whole program on a computer where a joystick is plugged in that this user may not open.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "emulated/emulated_vector_joystick.h"
#include "umockdev/mock_usb.h"

namespace osteon {
namespace {

struct Ran {
  int exit_code = -1;
  std::string output;
};

// The child sees the same made-up /sys and /dev: the preloaded library and the test bed's folder
// are in its environment.
Ran run(const std::string& arguments) {
  Ran ran;
  std::FILE* pipe =
      ::popen((std::string(OSTEON_EXECUTABLE) + " " + arguments + " 2>&1").c_str(), "r");
  if (!pipe) return ran;
  char block[4096];
  for (std::size_t got; (got = std::fread(block, 1, sizeof block, pipe)) > 0;)
    ran.output.append(block, got);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) ran.exit_code = WEXITSTATUS(status);
  return ran;
}

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
