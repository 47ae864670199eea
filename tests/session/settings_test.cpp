#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "osteon/session/session.h"

namespace osteon {
namespace {

using nlohmann::json;

// No value is a default.
SessionSettings odd_settings() {
  SessionSettings s;
  s.seed = 0xffffffffffffffffull;
  s.haptic.tick_s = 0.0005;
  s.haptic.stiffness_n_per_m = 1234.5678901234567;
  s.haptic.damping_n_s_per_m = 0.1;
  s.haptic.friction_scale = 1.0 / 3;
  s.haptic.max_force_n = 7.7;
  s.haptic.max_slew_n_per_s = 3999;
  s.haptic.max_turn_rad_per_tick = 0.04;
  s.haptic.force_on = false;
  s.physics.step_s = 0.004;
  s.physics.hold_bones = false;
  s.physics.spring_n_per_m = 2999;
  s.physics.spring_nm_per_rad = 0.51;
  s.physics.damping_ratio = 0.9;
  s.probe_radius_m = 0.00076;
  s.portals = {"3-4", "portal_mcr"};
  s.portal_skin = {401, 0.41, 0.31, 1.51};
  return s;
}

void expect_refused(const std::string& text, const std::string& saying) {
  const auto parsed = parse_settings(text);
  ASSERT_FALSE(parsed) << text;
  EXPECT_NE(parsed.error().message().find(saying), std::string::npos) << parsed.error().message();
}

TEST(Settings, RefuseWhatIsNoObject) {
  expect_refused("", "not a JSON object");
  expect_refused("[]", "not a JSON object");
  expect_refused("{", "not a JSON object");
  expect_refused("{}", "seed");
  expect_refused(std::string(100000, '['), "not a JSON object");
}

TEST(Settings, ComeBackToTheBit) {
  for (const SessionSettings& s : {SessionSettings{}, odd_settings()}) {
    const auto back = parse_settings(to_json(s));
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_EQ(back->seed, s.seed);
    EXPECT_EQ(back->haptic.tick_s, s.haptic.tick_s);
    EXPECT_EQ(back->haptic.stiffness_n_per_m, s.haptic.stiffness_n_per_m);
    EXPECT_EQ(back->haptic.damping_n_s_per_m, s.haptic.damping_n_s_per_m);
    EXPECT_EQ(back->haptic.friction_scale, s.haptic.friction_scale);
    EXPECT_EQ(back->haptic.max_force_n, s.haptic.max_force_n);
    EXPECT_EQ(back->haptic.max_slew_n_per_s, s.haptic.max_slew_n_per_s);
    EXPECT_EQ(back->haptic.max_turn_rad_per_tick, s.haptic.max_turn_rad_per_tick);
    EXPECT_EQ(back->haptic.force_on, s.haptic.force_on);
    EXPECT_EQ(back->physics.step_s, s.physics.step_s);
    EXPECT_EQ(back->physics.hold_bones, s.physics.hold_bones);
    EXPECT_EQ(back->physics.spring_n_per_m, s.physics.spring_n_per_m);
    EXPECT_EQ(back->physics.spring_nm_per_rad, s.physics.spring_nm_per_rad);
    EXPECT_EQ(back->physics.damping_ratio, s.physics.damping_ratio);
    EXPECT_EQ(back->probe_radius_m, s.probe_radius_m);
    EXPECT_EQ(back->portals, s.portals);
    EXPECT_EQ(back->portal_skin.squeeze_n, s.portal_skin.squeeze_n);
    EXPECT_EQ(to_json(*back), to_json(s));
  }
}

// Every setting in turn: left out, of a wrong kind, out of range, misspelt.
void break_each(const json& whole, const std::string& group) {
  const json& holder = group.empty() ? whole : whole[group];
  for (const auto& [key, value] : holder.items()) {
    if (value.is_object()) {
      break_each(whole, key);
      continue;
    }
    json changed = whole;
    json& target = group.empty() ? changed : changed[group];
    target.erase(key);
    if (key != "water" && key != "sights" && !key.ends_with("structures"))
      expect_refused(changed.dump(), key);  // older recordings have no word of it
    target[key] = "text";
    expect_refused(changed.dump(), key);
    target[key] = nullptr;
    expect_refused(changed.dump(), key);
    if (value.is_number_float()) {
      target[key] = -1.0;
      expect_refused(changed.dump(), key);
      target[key] = 1e200;
      expect_refused(changed.dump(), key);
    }
    target[key] = value;
    target[key + "_x"] = value;
    expect_refused(changed.dump(), key + "_x");
  }
}

TEST(Settings, AreReadStrictly) { break_each(json::parse(to_json(odd_settings())), ""); }

TEST(Settings, RefuseAStepThatIsNoWholeNumberOfTicks) {
  SessionSettings s;
  s.physics.step_s = 0.0025;
  EXPECT_FALSE(check_settings(s));
  s.physics.step_s = 0.0005;
  EXPECT_FALSE(check_settings(s));
  s.physics.step_s = 0.001;
  EXPECT_TRUE(check_settings(s));
  s.physics.step_s = 0.003;
  EXPECT_TRUE(check_settings(s));
}

TEST(Settings, RefuseWhatIsNotFinite) {
  SessionSettings s;
  s.haptic.max_force_n = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(check_settings(s));
  s.haptic.max_force_n = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(check_settings(s));
}

}  // namespace
}  // namespace osteon
