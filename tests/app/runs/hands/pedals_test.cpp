#include "runs/hands/pedals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ui/app_settings.h"

namespace osteon {
namespace {

PedalSource axis(const std::string& stick, int index, double rest, double full) {
  return {PedalKind::kAxis, stick, index, rest, full};
}

PedalReadings readings() {
  return {{65, 340}, {{"Wheel", {0, 0.2}, {false}}, {"T-Pedals", {-1, 0, 1}, {false, true}}}};
}

TEST(Pedals, WhatIsNotThereIsLetGo) {
  EXPECT_EQ(pedal_value({}, readings()), 0);
  EXPECT_EQ(pedal_value(axis("Gone", 0, -1, 1), readings()), 0);
  EXPECT_EQ(pedal_value(axis("T-Pedals", 3, -1, 1), readings()), 0);
  EXPECT_EQ(pedal_value(axis("T-Pedals", -1, -1, 1), readings()), 0);
  EXPECT_EQ(pedal_value({PedalKind::kButton, "T-Pedals", 9, 0, 1}, readings()), 0);
  EXPECT_EQ(pedal_value({PedalKind::kButton, "T-Pedals", -1, 0, 1}, readings()), 0);
  EXPECT_EQ(pedal_value({PedalKind::kKey, "", 66, 0, 1}, readings()), 0);
  EXPECT_EQ(pedal_value(axis("T-Pedals", 2, 1, 1), readings()), 0);  // no way at all
  PedalReadings broken = readings();
  broken.joysticks[1].axes[2] = std::nan("");
  EXPECT_EQ(pedal_value(axis("T-Pedals", 2, -1, 1), broken), 0);
}

TEST(Pedals, KeysButtonsAndAxesGiveTheirShare) {
  EXPECT_EQ(pedal_value({PedalKind::kKey, "", 340, 0, 1}, readings()), 1);
  EXPECT_EQ(pedal_value({PedalKind::kButton, "T-Pedals", 1, 0, 1}, readings()), 1);
  EXPECT_EQ(pedal_value({PedalKind::kButton, "T-Pedals", 0, 0, 1}, readings()), 0);
  EXPECT_EQ(pedal_value(axis("T-Pedals", 0, -1, 1), readings()), 0);
  EXPECT_EQ(pedal_value(axis("T-Pedals", 1, -1, 1), readings()), 0.5);
  EXPECT_EQ(pedal_value(axis("T-Pedals", 2, -1, 1), readings()), 1);
  EXPECT_EQ(pedal_value(axis("T-Pedals", 0, 1, -1), readings()), 1);  // one that is turned round
  EXPECT_EQ(pedal_value(axis("T-Pedals", 1, 0.5, 1), readings()), 0);
  EXPECT_NEAR(pedal_value(axis("", 1, 0, 1), readings()), 0.2, 1e-12);  // any joystick: the first
}

TEST(Pedals, LearnsWhatTheUserMoved) {
  const PedalReadings rest = readings();
  EXPECT_FALSE(moved_input(rest, rest));
  PedalReadings now = rest;
  now.joysticks[1].axes[0] = -0.9;
  EXPECT_FALSE(moved_input(rest, now)) << "a wavering pedal is not a press";
  now.joysticks[1].axes[0] = 0.4;
  now.joysticks[1].axes[1] = 0.3;
  EXPECT_EQ(moved_input(rest, now), axis("T-Pedals", 0, -1, 1));
  EXPECT_EQ(pedal_value(*moved_input(rest, now), now), 0.7);
  now.joysticks[0].buttons[0] = true;
  EXPECT_EQ(moved_input(rest, now), (PedalSource{PedalKind::kButton, "Wheel", 0, 0, 1}));
  now.keys.push_back(32);
  EXPECT_EQ(moved_input(rest, now), (PedalSource{PedalKind::kKey, {}, 32, 0, 1}));
  EXPECT_NE(describe(*moved_input(rest, now)), describe(PedalSource{}));
}

TEST(Pedals, AHeldPedalDoesNotFlutter) {
  Pedals pedals;
  EXPECT_FALSE(pedals.has(kDeadManPedal));
  pedals.set_map({{kDeadManPedal, axis("", 0, 0, 1)}, {kClutchPedal, {}}});
  EXPECT_TRUE(pedals.has(kDeadManPedal));
  EXPECT_FALSE(pedals.has(kClutchPedal));
  const auto at = [&](double x) {
    pedals.update({{}, {{"P", {x}, {}}}});
    return pedals.held(kDeadManPedal);
  };
  EXPECT_FALSE(at(0.45));
  EXPECT_TRUE(at(0.55));
  EXPECT_TRUE(at(0.45));
  EXPECT_FALSE(at(0.3));
  EXPECT_TRUE(at(1));
  EXPECT_EQ(pedals.value(kDeadManPedal), 1);
  pedals.update({});  // unplugged
  EXPECT_FALSE(pedals.held(kDeadManPedal));
}

TEST(HandSettings, MappingsAndPedalsComeBackAndNonsenseDoesNot) {
  AppSettings settings;
  DeviceInfo arm;
  arm.driver = "phantom";
  arm.serial = "A1";
  const std::string key = mapping_key(arm, "wrist");
  settings.mappings[key] = {2.5, MappingAxes::kPatient, 1, 0.2, 0.05};
  settings.pedals[kDeadManPedal] = axis("T-Pedals", 2, -1, 1);
  settings.pedals["drill"] = {PedalKind::kKey, "", 340, 0, 1};
  const auto back = parse_app_settings(to_json(settings));
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, settings);
  EXPECT_EQ(mapping_of(back->mappings, key), settings.mappings[key]);
  arm.serial = "B2";
  EXPECT_EQ(mapping_of(back->mappings, mapping_key(arm, "wrist")), MappingSettings{});

  const auto odd = parse_app_settings(
      R"({"mappings": {"a": {"scale": 1e9, "axes": 3, "clutch_button": 70, "friction_n": "x"},
          "b": 4}, "pedals": {"p": {"kind": "lever", "index": 99999}, "q": []}})");
  ASSERT_TRUE(odd);
  EXPECT_EQ(odd->mappings.at("a").scale, kMaxScale);
  EXPECT_EQ(odd->mappings.at("a").clutch_button, -1);
  EXPECT_EQ(odd->mappings.count("b"), 0u);
  EXPECT_EQ(odd->pedals.at("p"), PedalSource{});
  EXPECT_TRUE(parse_app_settings(R"({"mappings": 3, "pedals": null})"));
}

}  // namespace
}  // namespace osteon
