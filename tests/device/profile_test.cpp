#include "osteon/device/profile.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "osteon/base/file.h"

namespace osteon {
namespace {

const char* const kSound = R"(name = "Test"
driver = "virtual"
rate_hz = 1000
[force]
axes = [true, false, true]
peak_n = 8.5
continuous_n = 2
max_stiffness_n_per_m = 3000
max_slew_n_per_s = 4000
[torque]
axes = [false, false, true]
[workspace]
extent_mm = [100, 80.5, 60]
)";

Result<DeviceInfo> load_text(const std::string& text) {
  // A file of its own for each process: tests run side by side.
  const auto path = std::filesystem::path(::testing::TempDir()) /
                    ("osteon_profile_" + std::to_string(::getpid()) + ".toml");
  EXPECT_TRUE(write_file_atomic(path, text));
  auto info = load_device_profile(path);
  std::filesystem::remove(path);
  return info;
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = kSound;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(DeviceProfile, ReadsEveryField) {
  const auto info = load_text(kSound);
  ASSERT_TRUE(info) << info.error().message();
  EXPECT_EQ(info->name, "Test");
  EXPECT_EQ(info->driver, "virtual");
  EXPECT_EQ(info->rate_hz, 1000);
  EXPECT_EQ(info->force_axes, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(info->torque_axes, (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(info->peak_force_n, 8.5);
  EXPECT_EQ(info->continuous_force_n, 2);
  EXPECT_EQ(info->max_stiffness_n_per_m, 3000);
  EXPECT_EQ(info->max_slew_n_per_s, 4000);
  EXPECT_LT((info->workspace_m - Vec3(0.1, 0.0805, 0.06)).norm(), 1e-15);
  EXPECT_FALSE(info->drives_rotation());  // no limits, no torque
  const auto driven = load_text(with("axes = [false, false, true]",
                                     "axes = [false, false, true]\npeak_nm = 0.2\n"
                                     "continuous_nm = 0.05\nmax_slew_nm_per_s = 40"));
  ASSERT_TRUE(driven) << driven.error().message();
  EXPECT_TRUE(driven->drives_rotation());
  EXPECT_EQ(driven->peak_torque_nm, 0.2);
  EXPECT_EQ(driven->continuous_torque_nm, 0.05);
  EXPECT_EQ(driven->max_torque_slew_nm_per_s, 40);
}

TEST(DeviceProfile, RefusesAndNamesEveryBrokenKey) {
  const struct {
    const char* from;
    const char* to;
    const char* named;
  } cases[] = {
      {"name = \"Test\"", "", "'name'"},
      {"name = \"Test\"", "name = \"\"", "'name'"},
      {"driver = \"virtual\"", "driver = 3", "'driver'"},
      {"rate_hz = 1000", "rate_hz = 0", "'rate_hz'"},
      {"rate_hz = 1000", "rate_hz = nan", "'rate_hz'"},
      {"rate_hz = 1000", "rate_hz = \"fast\"", "'rate_hz'"},
      {"rate_hz = 1000", "rate_hz = 1000\ncolour = 1", "'colour'"},
      {"axes = [true, false, true]", "axes = [true, false]", "'axes'"},
      {"axes = [true, false, true]", "axes = [1, 0, 1]", "'axes'"},
      {"peak_n = 8.5", "peak_n = -1", "'peak_n'"},
      {"peak_n = 8.5", "peak_n = inf", "'peak_n'"},
      {"peak_n = 8.5", "peak_n = 1", "'continuous_n'"},
      {"continuous_n = 2", "", "'continuous_n'"},
      {"max_stiffness_n_per_m = 3000", "max_stiffness = 3000", "'max_stiffness'"},
      {"[torque]", "[torques]", "'torques'"},
      {"[workspace]\nextent_mm = [100, 80.5, 60]", "", "[workspace]"},
      {"extent_mm = [100, 80.5, 60]", "extent_mm = [100, 0, 60]", "'extent_mm'"},
  };
  for (const auto& c : cases) {
    const auto info = load_text(with(c.from, c.to));
    ASSERT_FALSE(info) << c.to;
    EXPECT_NE(info.error().what.find(c.named), std::string::npos)
        << c.to << " -> " << info.error().message();
  }
}

TEST(DeviceProfile, BrokenTomlNamesItsLine) {
  const auto info = load_text(with("rate_hz = 1000", "rate_hz = = 1000"));
  ASSERT_FALSE(info);
  EXPECT_NE(info.error().where.find("line 3"), std::string::npos) << info.error().message();
  EXPECT_FALSE(load_device_profile("/nowhere/at/all.toml"));
}

}  // namespace
}  // namespace osteon
