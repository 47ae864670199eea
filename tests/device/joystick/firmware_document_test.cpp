// docs/joystick-firmware.md says what the emulated joysticks do, to the byte.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "emulated/emulated_vector_joystick.h"
#include "emulated/joystick_descriptors.h"
#include "joystick/vector_report.h"

namespace osteon {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Every fenced block after a line "<!-- bytes: NAME -->".
std::map<std::string, Bytes> documented() {
  std::ifstream in(std::string(OSTEON_SOURCE_DIR) + "/docs/joystick-firmware.md");
  const std::string mark = "<!-- bytes: ";
  std::map<std::string, Bytes> blocks;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(mark)) continue;
    const std::string name = line.substr(mark.size(), line.find(" -->") - mark.size());
    std::getline(in, line);  // the fence
    while (std::getline(in, line) && !line.starts_with("```")) {
      std::istringstream words(line);
      for (std::string word; words >> word;)
        blocks[name].push_back(static_cast<std::uint8_t>(std::stoi(word, nullptr, 16)));
    }
  }
  return blocks;
}

Bytes bytes_of(std::span<const std::uint8_t> span) { return {span.begin(), span.end()}; }

TEST(FirmwareDocument, DescriptorsAreWhatTheEmulationAnswers) {
  auto blocks = documented();
  const JoystickDescriptors vector = vector_joystick_descriptors();
  const JoystickDescriptors pid = pid_joystick_descriptors();
  EXPECT_EQ(blocks["vector device"], bytes_of(vector.device));
  EXPECT_EQ(blocks["vector configuration"], bytes_of(vector.configuration));
  EXPECT_EQ(blocks["pid configuration"], bytes_of(pid.configuration));
  EXPECT_EQ(pid.configuration[25] | pid.configuration[26] << 8,
            static_cast<int>(pid.report.size()));
}

TEST(FirmwareDocument, TheReportWithATorqueIsWhatTheHostSendsAndTheFirmwareTakes) {
  const Bytes report = documented()["vector out with torque"];
  EXPECT_EQ(report, bytes_of(encode_with_torque({VectorCommand::kMotorsOn, 0x1234, Vec3(1, -2.5, 0),
                                                 Vec3(0, 0, -0.0412)})));
  EmulatedVectorJoystick joystick;
  joystick.take_out(0x02, report);
  EXPECT_EQ(joystick.refused(), 1u);  // it has no such motor
  joystick.set_drives_rotation(true);
  joystick.take_out(0x02, report);
  EXPECT_EQ(joystick.refused(), 1u);
  EXPECT_LT((joystick.mechanics().turning_motors() - Vec3(0, 0, -0.0412)).norm(), 1e-12);
  for (std::size_t bit = 0; bit < 8 * report.size(); ++bit) {
    Bytes broken = report;
    broken[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    joystick.take_out(0x02, broken);
  }
  EXPECT_EQ(joystick.refused(), 1 + 8u * report.size());
}

TEST(FirmwareDocument, TheForceReportIsWhatTheHostSendsAndTheFirmwareTakes) {
  auto blocks = documented();
  const Bytes report = blocks["vector out"];
  EXPECT_EQ(report, bytes_of(encode({VectorCommand::kMotorsOn, 0x1234, Vec3(1, -2.5, 0)})));
  EmulatedVectorJoystick joystick;
  joystick.take_out(0x02, report);
  EXPECT_EQ(joystick.refused(), 0u);
  EXPECT_LT((joystick.mechanics().motors() - Vec3(1, -2.5, 0)).norm(), 1e-12);
  for (std::size_t bit = 0; bit < 8 * report.size(); ++bit) {
    Bytes broken = report;
    broken[bit / 8] ^= static_cast<std::uint8_t>(1u << (bit % 8));
    joystick.take_out(0x02, broken);
  }
  EXPECT_EQ(joystick.refused(), 8u * report.size());
}

}  // namespace
}  // namespace osteon
