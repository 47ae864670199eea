#include "osteon/procedure/scenario.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

std::string scenario_with(const std::string& line) {
  return "format = 1\nname = \"w\"\ntitle = \"W\"\ntext = \"W\"\nversion = 1\nanatomy = "
         "\"wrist\"\n" +
         line +
         "[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n[[stages.goals]]\n"
         "rule = \"touched\"\n";
}

TEST(ScenarioToml, AnExpertMayBeShownUnlessTheFileSaysNo) {
  const auto silent = parse_scenario(scenario_with(""), "w.toml");
  ASSERT_TRUE(silent) << silent.error().message();
  EXPECT_TRUE(silent->ghost);
  const auto exam = parse_scenario(scenario_with("ghost = false\n"), "w.toml");
  ASSERT_TRUE(exam) << exam.error().message();
  EXPECT_FALSE(exam->ghost);
  const auto bad = parse_scenario(scenario_with("ghost = \"no\"\n"), "w.toml");
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message().find("w.toml:7"), std::string::npos) << bad.error().message();
}

TEST(ScenarioToml, APatientHasOneOfTheFindingsThatAreNamed) {
  const auto drawn =
      parse_scenario(scenario_with("one_of = [\"a=1:b=2\", \"a=2:b=1\"]\n"), "w.toml");
  ASSERT_TRUE(drawn) << drawn.error().message();
  EXPECT_EQ(drawn->one_of, (std::vector<std::string>{"a=1:b=2", "a=2:b=1"}));
  EXPECT_FALSE(parse_scenario(scenario_with("one_of = [\"a\"]\n"), "w.toml"));
}

TEST(ScenarioToml, ARuleNamesWhomItIsAskedOf) {
  const std::string text = scenario_with("");
  const auto asked = parse_scenario(text + "when = \"a=1\"\nunless = \"b=2\"\n", "w.toml");
  ASSERT_TRUE(asked) << asked.error().message();
  EXPECT_EQ(asked->stages[0].goals[0].when, "a=1");
  EXPECT_EQ(asked->stages[0].goals[0].unless, "b=2");
  const auto bad = parse_scenario(text + "unless = \"b\"\n", "w.toml");
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message().find("grade"), std::string::npos) << bad.error().message();
}

}  // namespace
}  // namespace osteon
