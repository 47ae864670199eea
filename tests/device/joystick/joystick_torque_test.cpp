// A joystick whose rotation has a motor: every torque goes through the report's bytes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <string>

#include "emulated/emulated_vector_joystick.h"
#include "emulated/virtual_usb.h"
#include "joystick/vector_report.h"
#include "osteon/base/file.h"

namespace osteon {
namespace {

std::filesystem::path shipped_joystick(const char* file) {
  return std::filesystem::path(OSTEON_SOURCE_DIR) / "assets" / "devices" / file;
}

struct DrivenJoystick {
  DrivenJoystick() {
    auto opened = VirtualUsbJoystick::open(
        load_joystick_profile(shipped_joystick("joystick_vector_torque.toml")).value());
    EXPECT_TRUE(opened) << opened.error().message();
    device = std::move(*opened);
    device->read();
  }
  Vec3 turned_by() const { return device->mechanics().turning_motors(); }
  void write(const Vec3& force_V, const Vec3& torque_V) {
    device->write({force_V, torque_V});
    device->read();
  }
  std::unique_ptr<VirtualUsbJoystick> device;
};

TEST(JoystickTorque, ReachesTheMotorOfItsDrivenAxisAlone) {
  DrivenJoystick joystick;
  joystick.write(Vec3(0.5, 0, 0), Vec3(0.02, 0.03, -0.0412));
  EXPECT_LT((joystick.turned_by() - Vec3(0, 0, -0.0412)).norm(), 1e-12);
  EXPECT_LT((joystick.device->mechanics().motors() - Vec3(0.5, 0, 0)).norm(), 1e-12);
  // For that force alone.
  joystick.device->write_force(Vec3(0.5, 0, 0));
  joystick.device->read();
  EXPECT_EQ(joystick.turned_by(), Vec3::Zero());
}

TEST(JoystickTorque, NotANumberIsNoForceAndNoTorque) {
  DrivenJoystick joystick;
  joystick.write(Vec3(0.5, 0, 0), Vec3(0, 0, 0.02));
  ASSERT_NEAR(joystick.turned_by().z(), 0.02, 1e-12);
  ASSERT_GT(joystick.device->mechanics().motors().norm(), 0);
  joystick.write(Vec3(0.5, 0, 0), Vec3(0, 0, std::nan("")));
  EXPECT_EQ(joystick.turned_by(), Vec3::Zero());
  EXPECT_EQ(joystick.device->mechanics().motors(), Vec3::Zero());
}

// The program stalls: the firmware lets both go, and the driver says so until zero was written.
TEST(JoystickTorque, EndsWithTheFirmwaresTimeOut) {
  DrivenJoystick joystick;
  joystick.write(Vec3::Zero(), Vec3(0, 0, 0.05));
  EXPECT_NEAR(joystick.turned_by().z(), 0.05, 1e-12);
  joystick.device->bus().advance(25'000'000);
  EXPECT_EQ(joystick.turned_by(), Vec3::Zero());
  EXPECT_EQ(joystick.device->read().refusal, ForceOff::kWatchdog);
}

TEST(JoystickTorque, TheReportIsByteForByteAsSpecified) {
  const VectorCommand command{VectorCommand::kMotorsOn, 0x1234, Vec3(1, -2.5, 0),
                              Vec3(0, 0, -0.0412)};
  const auto report = encode_with_torque(command);
  const std::vector<std::uint8_t> head = {0x03, 0x01, 0x34, 0x12, 0xE8, 0x03, 0x3C, 0xF6,
                                          0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x64, 0xFE};
  EXPECT_TRUE(std::equal(head.begin(), head.end(), report.begin()));
  EXPECT_EQ(report[16] | report[17] << 8, crc16_ccitt({report.data(), 16}));
  const auto far = encode_with_torque({VectorCommand::kMotorsOn, 1, Vec3::Zero(), Vec3(9, -9, 0)});
  EXPECT_EQ(far[10] | far[11] << 8, 0x7FFF);
  EXPECT_EQ(far[12] | far[13] << 8, 0x8001);
  const auto bad =
      encode_with_torque({VectorCommand::kMotorsOn, 1, Vec3(1, 0, 0), Vec3(HUGE_VAL, 0, 0)});
  for (std::size_t i = 4; i < 16; ++i) EXPECT_EQ(bad[i], 0);
  EXPECT_EQ(bad[1], 0);
}

std::string with_changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(JoystickTorque, AProfileSaysItsLimitsAndPidDrivesNone) {
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("osteon_torque_" + std::to_string(::getpid()) + ".toml");
  const auto complaint = [&](const std::string& text) {
    EXPECT_TRUE(write_file_atomic(file, text));
    const auto profile = load_joystick_profile(file);
    return profile ? std::string() : profile.error().message();
  };
  const std::string sound = read_file(shipped_joystick("joystick_vector_torque.toml")).value();
  EXPECT_EQ(complaint(sound), "");
  EXPECT_NE(complaint(with_changed(sound, "peak_nm", "peek_nm")).find("peek_nm"),
            std::string::npos);
  EXPECT_NE(complaint(with_changed(sound, "peak_nm = 0.1", "peak_nm = nan")), "");
  EXPECT_NE(complaint(with_changed(sound, "continuous_nm = 0.04", "continuous_nm = 0.4"))
                .find("'continuous_nm' is above 'peak_nm'"),
            std::string::npos);
  const std::string pid = read_file(shipped_joystick("joystick_pid.toml")).value();
  EXPECT_NE(complaint(with_changed(pid, "[torque]\naxes = [false, false, false]",
                                   "[torque]\npeak_nm = 0.1\ncontinuous_nm = 0.04\n"
                                   "max_slew_nm_per_s = 50\naxes = [false, false, true]"))
                .find("drives no rotation"),
            std::string::npos);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace osteon
