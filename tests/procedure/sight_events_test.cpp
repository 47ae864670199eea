#include "osteon/procedure/sight_events.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "osteon/procedure/attempt.h"
#include "osteon/procedure/judge.h"

namespace osteon {
namespace {

// One error: nothing could be seen for 5 s.
struct Clouded {
  Clouded() {
    const std::string text =
        "format = 1\nname = \"look\"\ntitle = \"L\"\ntext = \"L\"\nversion = 1\n"
        "anatomy = \"knee\"\n[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n"
        "[[stages.goals]]\nrule = \"touched\"\nbones = [\"femur\"]\n"
        "[[errors]]\nname = \"blind\"\ntitle = \"T\"\nseverity = \"minor\"\nconsequence = \"c\"\n"
        "source = \"D\"\nrule = \"obscured\"\nfor_s = 5\n";
    auto scenario = parse_scenario(text, "look.toml");
    EXPECT_TRUE(scenario) << scenario.error().message();
    c.bones.resize(1);
    c.bones[0].name = "femur";
    plan = *plan_scenario(*scenario, c);
    state = begin_scenario(plan);
  }
  void look(double from_s, double to_s, bool obscured) {
    for (double t = from_s; t < to_s - 1e-9; t += 0.1) {
      Event event;
      event.tick = static_cast<std::uint64_t>(t * 1000 + 0.5);
      event.kind = kWaterLooked;
      event.hand = 0;
      event.values = {obscured ? 1.0 : 0.0, 0.6, 45};
      judge(plan, event, 0.001, state);
    }
  }
  Case c;
  ScenarioPlan plan;
  ScenarioState state;
};

TEST(ObscuredRule, CountsOnceWhenItHasLastedAndAnewAfterAClearLook) {
  Clouded clouded;
  clouded.look(0, 4, true);
  clouded.look(4, 5, false);
  clouded.look(5, 9.5, true);
  EXPECT_TRUE(clouded.state.errors.empty());
  clouded.look(9.5, 20, true);
  ASSERT_EQ(clouded.state.errors.size(), 1u);
  EXPECT_NEAR(clouded.state.errors[0].at_s, 5, 0.01);
  clouded.look(20, 21, false);
  clouded.look(21, 27, true);
  EXPECT_EQ(clouded.state.errors.size(), 2u);
}

TEST(ObscuredSight, IsInTheReportOfWhoLookedAlone) {
  Outcome outcome;
  const Report report;
  EXPECT_FALSE(nlohmann::json::parse(to_json(report, outcome)).contains("sight"));
  EXPECT_EQ(to_text(outcome).find("sight"), std::string::npos);
  outcome.sight = ObscuredSight{40, 10, {{3, 13, SightLost::kBlood}}};
  const auto sight = nlohmann::json::parse(to_json(report, outcome))["sight"];
  EXPECT_EQ(sight["scope_s"], 40);
  EXPECT_EQ(sight["obscured_s"], 10);
  EXPECT_EQ(sight["obscured_percent"], 25);
  ASSERT_EQ(sight["stretches"].size(), 1u);
  EXPECT_EQ(sight["stretches"][0]["cause"], "blood");
  EXPECT_NE(to_text(outcome).find("obscured for 10.0 of 40.0 s"), std::string::npos);
  EXPECT_EQ(ObscuredSight().percent(), 0);
}

}  // namespace
}  // namespace osteon
