#include "osteon/procedure/asked_findings.h"

#include <gtest/gtest.h>

#include "osteon/procedure/attempt.h"
#include "report_fixtures.h"

namespace osteon {
namespace {

const std::vector<AskedFinding> kAsked{{"geissler", "Gap", {"1", "2", "3"}, 0},
                                       {"tear", "Tear", {"1A"}, 0}};

Case ill_case() {
  Case c = testing::named_case({"lunate"});
  c.findings = {{"geissler", "2", "a step"}, {"traction", "10kg", "pulled"}};
  return c;
}

TEST(AskedFindings, AreGradedAgainstTheCase) {
  const auto graded = grade_findings(kAsked, ill_case(), {{"geissler", "3"}, {"tear", "none"}});
  ASSERT_EQ(graded.size(), 2u);
  EXPECT_EQ(graded[0].truth, "2");
  EXPECT_FALSE(graded[0].right());
  EXPECT_EQ(graded[1].truth, kNoFinding);
  EXPECT_TRUE(graded[1].right());
  EXPECT_DOUBLE_EQ(share_right_percent(graded), 50);
  // Who says nothing is not right, not even of what is not there.
  EXPECT_DOUBLE_EQ(share_right_percent(grade_findings(kAsked, ill_case(), {})), 0);
  const StatedFindings truth = true_findings(kAsked, ill_case());
  EXPECT_DOUBLE_EQ(share_right_percent(grade_findings(kAsked, ill_case(), truth)), 100);
  EXPECT_DOUBLE_EQ(share_right_percent({}), 0);
}

TEST(AskedFindings, AreReadStrictlyAndWrittenBack) {
  for (const char* bad :
       {"", "[]", "3", "{", "{\"geissler\": 3}", "{\"geissler\": \"4\"}", "{\"other\": \"1\"}"})
    EXPECT_FALSE(parse_findings(bad, kAsked, "f.json")) << bad;
  const StatedFindings stated{{"geissler", "none"}, {"tear", "1A"}};
  const auto back = parse_findings(to_json(stated), kAsked, "f.json");
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(*back, stated);
  EXPECT_TRUE(parse_findings("{}", {}, "f.json"));
}

TEST(AskedFindings, AreAskedByAScenarioAndCountAsAMetricAndInTheReport) {
  const std::string text =
      "format = 1\nname = \"w\"\ntitle = \"W\"\ntext = \"W\"\nversion = 1\nanatomy = \"wrist\"\n"
      "[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n[[stages.goals]]\n"
      "rule = \"touched\"\n[[asks]]\nfinding = \"geissler\"\ntitle = \"Gap\"\n";
  EXPECT_FALSE(parse_scenario(text, "w.toml")) << "no grades";
  const auto scenario = parse_scenario(text + "grades = [\"1\", \"2\"]\n", "w.toml");
  ASSERT_TRUE(scenario) << scenario.error().message();
  const Case c = ill_case();
  const auto plan = plan_scenario(*scenario, c);
  ASSERT_TRUE(plan);
  const ScenarioState state = begin_scenario(*plan);
  const auto right = outcome_of(*plan, c, state, {}, nullptr, {{"geissler", "2"}});
  ASSERT_TRUE(right);
  EXPECT_EQ(right->metrics.at(kFindingsRight), 100);
  const auto silent = outcome_of(*plan, c, state, {}, nullptr);
  EXPECT_EQ(silent->metrics.at(kFindingsRight), 0);
  const std::string json = to_json(testing::sample_report(), *right);
  EXPECT_NE(json.find("\"truth\": \"2\""), std::string::npos) << json;
  EXPECT_NE(to_text(*silent).find("nothing stated, is 2"), std::string::npos);
}

}  // namespace
}  // namespace osteon
