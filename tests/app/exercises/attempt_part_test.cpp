#include "exercises/attempt_part.h"

#include <gtest/gtest.h>

#include "cases/open_case.h"
#include "exercises/scenario_files.h"

namespace osteon {
namespace {

class AttemptPartTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto opened = open_scenario("touch_bones");
    ASSERT_TRUE(opened) << opened.error().message();
    scenario = std::move(*opened);
  }
  Scenario scenario;
};

TEST_F(AttemptPartTest, ItsNoteIsReadAsItWasWritten) {
  const AttemptPart part{"metacarpals", "forearm", 40211};
  const auto read = parse_part(to_text(part), "file");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(*read, part);
  for (const char* bad : {"", "a", "a b", "a b c", "a b -1 d", "a b 3 d"})
    EXPECT_FALSE(parse_part(bad, "file")) << bad;
}

TEST_F(AttemptPartTest, StagesAreFoundByNameInTheirOrder) {
  const auto stages = stages_of({"metacarpals", "forearm"}, scenario);
  ASSERT_TRUE(stages) << stages.error().message();
  EXPECT_EQ(stages->first, 1u);
  EXPECT_EQ(stages->last, 2u);
  const auto unknown = stages_of({"metacarpals", "elbow"}, scenario);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message().find("metacarpals, forearm"), std::string::npos);
  EXPECT_FALSE(stages_of({"forearm", "carpals"}, scenario)) << "backwards";
  scenario.stages[1].restore_point = false;
  EXPECT_FALSE(stages_of({"metacarpals", "forearm"}, scenario));
  scenario.stages[0].restore_point = false;
  const auto from_the_start = stages_of({"carpals", "metacarpals"}, scenario);
  ASSERT_TRUE(from_the_start) << "the exercise itself begins there";
  EXPECT_EQ(from_the_start->last, 1u);
}

TEST_F(AttemptPartTest, WhatIsBeforeAndAfterItIsLeftOutAndTimesBeginWithIt) {
  const auto the_case = open_case("builtin:wrist", {}, CaseParts::kFelt);
  ASSERT_TRUE(the_case);
  const auto plan = plan_scenario(scenario, **the_case);
  ASSERT_TRUE(plan);
  std::uint32_t left_out = 0;
  while (scenario.errors[left_out].rule.kind != "left_out") ++left_out;
  ScenarioState state = begin_scenario(*plan);
  state.stage = 2;
  state.completed_s = {3, 11, -1};
  state.errors = {{0, 2}, {0, 7}, {left_out, 12}};
  const PartOfAttempt middle = part_of(*plan, state, {1, 1}, 5);
  ASSERT_EQ(middle.plan.scenario.stages.size(), 1u);
  EXPECT_EQ(middle.plan.scenario.stages[0].name, "metacarpals");
  EXPECT_EQ(middle.plan.goals.size(), 1u);
  EXPECT_EQ(middle.state.completed_s, std::vector<double>{6});
  ASSERT_EQ(middle.state.errors.size(), 1u) << "what comes after it is not left out";
  EXPECT_EQ(middle.state.errors[0].at_s, 2);
  EXPECT_EQ(middle.state.stage, 1u);
  const PartOfAttempt end = part_of(*plan, state, {1, 2}, 5);
  EXPECT_EQ(end.state.completed_s, (std::vector<double>{6, -1}));
  EXPECT_EQ(end.state.errors.size(), 2u) << "to the end: what is left out is";
}

}  // namespace
}  // namespace osteon
