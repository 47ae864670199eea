#include "ui/app_settings.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "osteon/base/file.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

class AppSettingsFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("osteon-settings-" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    file_ = folder_ / "deep" / "settings.json";
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_, file_;
};

AppSettings unusual() {
  AppSettings s;
  s.window_width = 1600;
  s.window_height = 901;
  s.interface_zoom = 1.25;
  s.panels_open = false;
  s.hint_dismissed = true;
  s.show_hulls = true;
  s.show_felt = true;
  s.show_heat = true;
  s.show_force = false;
  s.show_hand_ghost = false;
  s.light_azimuth_rad = 0.3;
  s.light_elevation_rad = -0.2;
  s.light_brightness = 1.4;
  s.sound_volume = 0.2;
  s.ambient_occlusion = 0;
  s.device = "gamepad";
  s.left_card = 200;
  s.recent = {"builtin:knee", "/home/a/run.osr"};
  s.stiffness_n_per_m = 900;
  s.friction_scale = 0.5;
  s.bones_held = false;
  s.looks["builtin:wrist"]["scaphoid"] = {{0.25f, 0.5f, 1.0f}, 0.5f, true};
  s.looks["builtin:wrist"]["lunate"] = {{0.75f, 0.5f, 0.0f}, 1.0f, false};
  s.looks["/cases/a \"b\""]["stone"] = {{0, 0, 0}, 0, true};
  return s;
}

TEST_F(AppSettingsFile, RoundTripKeepsEveryValue) {
  ASSERT_TRUE(save_app_settings(unusual(), file_));
  std::string message;
  EXPECT_EQ(load_app_settings(file_, &message), unusual());
  EXPECT_EQ(message, "");
}

TEST_F(AppSettingsFile, NoFileMeansDefaultsWithoutAWord) {
  std::string message;
  EXPECT_EQ(load_app_settings(file_, &message), AppSettings{});
  EXPECT_EQ(message, "");
}

TEST_F(AppSettingsFile, ADamagedFileMeansDefaultsAMessageAndIsKept) {
  const std::string whole = to_json(unusual());
  for (const std::string& damaged :
       {std::string(), std::string("\0\x01\xff", 3), whole.substr(0, whole.size() / 2),
        std::string("[1, 2]"), std::string("42")}) {
    fs::create_directories(file_.parent_path());
    ASSERT_TRUE(write_file_atomic(file_, damaged));
    std::string message;
    EXPECT_EQ(load_app_settings(file_, &message), AppSettings{});
    EXPECT_NE(message.find("settings could not be read"), std::string::npos);
    EXPECT_EQ(*read_file(file_.string() + ".damaged"), damaged);
    EXPECT_FALSE(fs::exists(file_));
  }
}

TEST_F(AppSettingsFile, AFolderInItsPlaceIsToldNotFollowed) {
  fs::create_directories(file_);
  std::string message;
  EXPECT_EQ(load_app_settings(file_, &message), AppSettings{});
  EXPECT_NE(message, "");
}

TEST(AppSettings, EveryCutOfTheTextIsSurvived) {
  const std::string whole = to_json(unusual());
  for (std::size_t n = 0; n + 2 < whole.size(); ++n)
    EXPECT_FALSE(parse_app_settings(whole.substr(0, n))) << n;
}

TEST(AppSettings, ValuesOfAnotherTypeOrOutOfRangeKeepTheirDefault) {
  const auto s = parse_app_settings(
      R"({"window_width": "wide", "window_height": 1e300, "interface_zoom": -1, "panels_open": 3,
          "light_brightness": null, "device": 7, "stiffness_n_per_m": 1e9, "friction_scale": 1.5,
          "unknown": {}})");
  ASSERT_TRUE(s);
  AppSettings expected;
  expected.friction_scale = 1.5;
  EXPECT_EQ(*s, expected);
}

TEST(AppSettings, LooksThatMakeNoSenseAreLeftOut) {
  const auto s = parse_app_settings(R"({"looks": {"a": 3, "b": {
      "good": {"color": [0.5, 0.25, 7], "opacity": -3, "visible": "yes"},
      "short": {"color": [1, 2]}, "words": {"color": ["a", 0, 0]}, "number": 4}}})");
  ASSERT_TRUE(s);
  ASSERT_EQ(s->looks.size(), 1u);
  ASSERT_EQ(s->looks.at("b").size(), 1u);
  const BoneLook expected{{0.5f, 0.25f, 1.0f}, 1.0f, true};
  EXPECT_EQ(s->looks.at("b").at("good"), expected);
}

}  // namespace
}  // namespace osteon
