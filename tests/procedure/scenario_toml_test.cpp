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

}  // namespace
}  // namespace osteon
