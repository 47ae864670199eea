// A student's first question to the program: what is here, and may I feel it?
#include <nlohmann/json.hpp>
#include <set>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;
class Doctor : public CliTest {};

TEST_F(Doctor, ListsEveryDriverAndWhyItCannotBeUsed) {
  const Ran ran = run_osteon("devices");
  EXPECT_EQ(ran.exit_code, 0) << ran.output;
  for (const char* word : {"mouse", "gamepad", "virtual", "phantom", "joystick"})
    EXPECT_NE(ran.output.find(word), std::string::npos) << ran.output;
}

TEST_F(Doctor, TheListIsJsonToo) {
  const Ran ran = run_osteon("devices --json 2>/dev/null");
  ASSERT_EQ(ran.exit_code, 0);
  std::set<std::string> names;
  for (const Json& driver : Json::parse(ran.output)) {
    names.insert(driver["driver"].get<std::string>());
    EXPECT_TRUE(driver["devices"].is_array());
    EXPECT_TRUE(driver["unusable"].is_array());
  }
  EXPECT_TRUE(names.count("mouse") && names.count("virtual") && names.count("null"));
}

TEST_F(Doctor, AMissingLibraryIsSaidAndNothingFails) {
  ::setenv("OSTEON_HD_LIBRARY", file("no_such_libHD.so").c_str(), 1);
  const Ran devices = run_osteon("devices");
  const Ran doctor = run_osteon("doctor --seconds 0.2");
  ::unsetenv("OSTEON_HD_LIBRARY");
  EXPECT_EQ(devices.exit_code, 0);
  EXPECT_NE(devices.output.find("no_such_libHD.so"), std::string::npos) << devices.output;
  EXPECT_NE(doctor.output.find("no_such_libHD.so"), std::string::npos) << doctor.output;
}

TEST_F(Doctor, ChecksTimingLimitsAndGraphicsAndEndsWithAVerdict) {
  const Ran ran = run_osteon("doctor --seconds 0.3");
  for (const char* word : {"ticks a second", "rtprio", "OpenGL", "USB"})
    EXPECT_NE(ran.output.find(word), std::string::npos) << word << " in\n" << ran.output;
  // Without a display driver the verdict may be no; it must be one of the two, and said.
  EXPECT_EQ(ran.exit_code == 0, ran.output.find("\nReady") != std::string::npos) << ran.output;
  EXPECT_EQ(ran.exit_code == 1, ran.output.find("\nNot ready") != std::string::npos) << ran.output;
}

TEST_F(Doctor, TriesADeviceWithAGentleForceOnlyWithConsent) {
  const Ran unasked = run_osteon("doctor --device virtual --seconds 0.1");
  EXPECT_NE(unasked.output.find("Readings"), std::string::npos) << unasked.output;
  EXPECT_EQ(unasked.output.find("moved the hand"), std::string::npos) << unasked.output;
  const Ran refused = run_osteon("doctor --device virtual --force-test --seconds 0.1 < /dev/null");
  EXPECT_EQ(refused.output.find("moved the hand"), std::string::npos) << refused.output;
  const Ran pushed = run_osteon("doctor --device virtual --force-test --yes --seconds 0.1");
  EXPECT_NE(pushed.output.find("X: 0.50 N moved the hand by"), std::string::npos) << pushed.output;
}

TEST_F(Doctor, ADeviceThatIsNotThereIsANo) {
  const Ran ran = run_osteon("doctor --device joystick9 --seconds 0.1");
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_NE(ran.output.find("Not ready"), std::string::npos) << ran.output;
}

TEST_F(Doctor, PrintsAndInstallsTheUdevRule) {
  const Ran printed = run_osteon("doctor --udev-rule 2>/dev/null");
  EXPECT_EQ(printed.exit_code, 0);
  EXPECT_NE(printed.output.find("uaccess"), std::string::npos) << printed.output;
  run_osteon("doctor --install-udev --seconds 0.1 --udev-folder " + dir_.string());
  std::FILE* rule = std::fopen(file("70-osteon.rules").c_str(), "r");
  ASSERT_NE(rule, nullptr);
  std::fclose(rule);
}

}  // namespace
}  // namespace osteon::testing_cli
