#include "osteon/scene/scope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const std::string kGood =
    "name = \"x\"\ntitle = \"X\"\ndiameter_mm = 4\nangle_deg = 30\nfield_deg = 105\nbarrel = 0.6\n"
    "source = [\"D\"]\n";

TEST(Scope, WhatIsWrongIsNamedWithItsLine) {
  const auto fails_with = [](const std::string& text, const std::string& words) {
    const auto got = parse_scope(text, "file");
    return !got && got.error().message().find(words) != std::string::npos;
  };
  EXPECT_TRUE(fails_with("name = ", "line 1"));
  EXPECT_TRUE(fails_with("", "'name'"));
  EXPECT_TRUE(fails_with(kGood + "colour = 3\n", "'colour'"));
  EXPECT_TRUE(fails_with(kGood + "colour = 3\n", "line 8"));
  std::string wide = kGood;
  wide.replace(wide.find("105"), 3, "190");
  EXPECT_TRUE(fails_with(wide, "'field_deg'"));
  std::string not_finite = kGood;
  not_finite.replace(not_finite.find("0.6"), 3, "nan");
  EXPECT_TRUE(fails_with(not_finite, "'barrel'"));
  EXPECT_FALSE(load_scope("no_such_scope"));
  EXPECT_FALSE(load_scope("../scopes/knee_30"));
}

TEST(Scope, AFileIsRead) {
  const auto scope = parse_scope(kGood, "file");
  ASSERT_TRUE(scope) << scope.error().message();
  EXPECT_NEAR(scope->angle_rad, 30 * kDegree, 1e-12);
  EXPECT_NEAR(scope->diameter_m, 0.004, 1e-12);
  EXPECT_NEAR(scope->barrel, 0.6, 1e-12);
}

TEST(Scope, WaterNarrowsTheField) {
  const auto scope = parse_scope(kGood, "file");
  ASSERT_TRUE(scope);
  EXPECT_NEAR(field_in_water_rad(*scope) / kDegree,
              2 * std::asin(std::sin(52.5 * kDegree) / 1.333) / kDegree, 1e-9);
  EXPECT_NEAR(field_in_water_rad(*scope) / kDegree, 73, 0.5);
}

TEST(Scope, TheFiveThatAreShippedAreGood) {
  const auto names = scope_names();
  ASSERT_TRUE(names);
  EXPECT_EQ(*names, (std::vector<std::string>{"knee_0", "knee_30", "knee_70", "wrist_30",
                                              "wrist_30_small"}));
  for (const std::string& name : *names) {
    const auto scope = load_scope(name);
    ASSERT_TRUE(scope) << scope.error().message();
    EXPECT_EQ(scope->name, name);
  }
  EXPECT_NEAR(load_scope("knee_70")->angle_rad, 70 * kDegree, 1e-12);
  EXPECT_NEAR(load_scope("wrist_30_small")->diameter_m, 0.0019, 1e-12);
}

}  // namespace
}  // namespace osteon
