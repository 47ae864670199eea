#include "osteon/procedure/judge.h"

#include <gtest/gtest.h>

#include "report_fixtures.h"

namespace osteon {
namespace {

const char* const kText = R"(format = 1
name = "two"
title = "Two bones"
text = "Touch them."
version = 1
anatomy = "wrist"

[[stages]]
name = "first"
title = "A"
instruction = "Touch radius and lunate."
[[stages.goals]]
rule = "touched"
bones = ["radius", "lunate"]
for_s = 0.2
force_n = 0.5

[[stages]]
name = "second"
title = "B"
instruction = "Touch them in order."
[[stages.goals]]
rule = "touched_in_order"
bones = ["lunate", "radius"]

[[errors]]
name = "too_hard"
title = "Too hard"
severity = "major"
consequence = "It bruises."
source = "D"
rule = "pressed_over"
force_n = 4
for_s = 0.1

[[errors]]
name = "stab"
title = "Stab"
severity = "critical"
consequence = "It breaks."
source = "D"
rule = "struck"
speed_mm_s = 100

[[errors]]
name = "forgot"
title = "Forgot one"
severity = "minor"
consequence = "Something is missed."
source = "D"
rule = "left_out"
)";

Scenario two() {
  auto scenario = parse_scenario(kText, "two.toml");
  EXPECT_TRUE(scenario) << scenario.error().message();
  return std::move(*scenario);
}

ScenarioPlan plan_two() {
  auto plan = plan_scenario(two(), testing::named_case({"radius", "lunate"}));
  EXPECT_TRUE(plan) << plan.error().message();
  return std::move(*plan);
}

Event at(double time_s, EventKind kind, std::uint32_t bone, std::array<double, 3> values = {}) {
  Event event;
  event.tick = static_cast<std::uint64_t>(time_s * 1000 + 0.5);
  event.kind = kind;
  event.hand = 0;
  event.subject_kind = SubjectKind::kBone;
  event.subject = bone;
  event.values = values;
  return event;
}

Event touch_end(double time_s, std::uint32_t bone, double for_s = 0.3, double peak_n = 1) {
  return at(time_s, EventKind::kContactEnd, bone, {for_s, peak_n, 0.1});
}

ScenarioState judged(const std::vector<Event>& events) {
  const ScenarioPlan plan = plan_two();
  ScenarioState state = begin_scenario(plan);
  for (const Event& event : events) judge(plan, event, 0.001, state);
  return state;
}

TEST(Scenario, ErrorsNameTheLine) {
  const auto broken = [](const std::string& from, const std::string& to) {
    std::string text = kText;
    text.replace(text.find(from), from.size(), to);
    const auto read = parse_scenario(text, "two.toml");
    return read ? std::string("read") : read.error().where;
  };
  EXPECT_EQ(broken("for_s = 0.2", "for_s = -1"), "two.toml:15");
  EXPECT_EQ(broken("for_s = 0.2", "for_x = 1"), "two.toml:15");
  EXPECT_EQ(broken("rule = \"struck\"", "rule = \"touched\""), "two.toml:42");
  EXPECT_EQ(broken("severity = \"minor\"", "severity = \"grave\""), "two.toml:48");
  EXPECT_EQ(broken("title = \"A\"\n", ""), "two.toml:8");
  EXPECT_EQ(broken("[[stages.goals]]", "[[stages.goals"), "two.toml:12");
  EXPECT_FALSE(parse_scenario("", "empty.toml"));
  EXPECT_FALSE(load_scenario("/nowhere/x.toml"));
}

TEST(Scenario, CheckFindsAMarkOnAMeniscusThatIsNotFelt) {
  Case the_case = testing::named_case({"radius", "lunate"});
  SoftPart meniscus;
  meniscus.name = "medial_meniscus";
  meniscus.kind = "meniscus";
  meniscus.mesh_W.vertices = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}};
  meniscus.mesh_W.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  the_case.softs.push_back(meniscus);
  the_case.landmarks.push_back({"horn", Vec3(0.002, 0.002, -0.0002), Vec3::Zero(), ""});
  the_case.landmarks.push_back({"beside", Vec3(0.002, 0.002, -0.005), Vec3::Zero(), ""});
  Scenario scenario = two();
  Rule felt;
  felt.kind = "felt";
  felt.marks = {"beside"};
  felt.line = 14;
  scenario.stages[0].goals.push_back(felt);
  EXPECT_TRUE(check_scenario(scenario, the_case).empty());
  scenario.stages[0].goals.back().marks = {"horn"};
  const auto lines = check_scenario(scenario, the_case);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("two.toml:14: the rule 'felt' can never be met: 'horn' lies on "
                          "'medial_meniscus'"),
            std::string::npos)
      << lines[0];
  for (const char* name : {"menisci", "medial_meniscus"}) {
    scenario.soft = {name};
    EXPECT_TRUE(check_scenario(scenario, the_case).empty()) << name;
  }
  scenario.soft = {"lateral_meniscus"};
  EXPECT_EQ(check_scenario(scenario, the_case).size(), 1u);
}

TEST(Scenario, CheckFindsRulesThatCanNeverBeMet) {
  const Case the_case = testing::named_case({"radius", "lunate"});
  EXPECT_TRUE(check_scenario(two(), the_case).empty());
  const auto lines = check_scenario(two(), testing::named_case({"radius"}));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find("two.toml:12: the rule 'touched' can never be met"), std::string::npos);
  Scenario hard = two();
  hard.stages[0].goals[0].numbers["force_n"] = 5;
  EXPECT_NE(check_scenario(hard, the_case).at(0).find("without the error 'too_hard'"),
            std::string::npos);
  Scenario slow = two();
  slow.stages[0].goals[0].numbers["for_s"] = 59;
  slow.time_limit_s = 60;
  EXPECT_EQ(check_scenario(slow, the_case).size(), 1u);
  Scenario twice = two();
  twice.stages[1].name = "first";
  twice.metrics.push_back({"beauty", "", 1, true, 0, "D"});
  EXPECT_EQ(check_scenario(twice, the_case).size(), 2u);
}

TEST(Judge, NothingHasHappenedAtTheStart) {
  const ScenarioState state = judged({});
  EXPECT_EQ(state.stage, 0u);
  EXPECT_EQ(state.completed_s, (std::vector<double>{-1, -1}));
  EXPECT_FALSE(state.over);
}

TEST(Judge, AStageIsDoneWhenEveryBoneWasTouchedEnough) {
  EXPECT_EQ(judged({touch_end(1, 0), touch_end(2, 1, 0.1)}).stage, 0u);     // too short
  EXPECT_EQ(judged({touch_end(1, 0), touch_end(2, 1, 1, 0.4)}).stage, 0u);  // too light
  const ScenarioState state = judged({touch_end(1, 0), touch_end(2, 1)});
  EXPECT_EQ(state.stage, 1u);
  EXPECT_DOUBLE_EQ(state.completed_s[0], 2);
}

TEST(Judge, InOrderMeansInOrder) {
  const std::vector<Event> first{touch_end(1, 0), touch_end(2, 1)};
  auto wrong = first;
  wrong.push_back(touch_end(3, 0));
  wrong.push_back(touch_end(4, 1));
  EXPECT_EQ(judged(wrong).stage, 1u);  // radius came before its turn and does not count
  wrong.push_back(touch_end(5, 0));
  const ScenarioState state = judged(wrong);
  EXPECT_TRUE(state.over);
  EXPECT_DOUBLE_EQ(state.completed_s[1], 5);
}

// What was done since a restore point is to be done again; an error stays.
TEST(Judge, GoesBackToWhatWasDoneAtARestorePoint) {
  const ScenarioState kept = judged({touch_end(1, 0)});
  ScenarioState state = judged({touch_end(1, 0), touch_end(2, 1)});
  state.errors.push_back({0, 1.5, 0, kNoSubject});
  ASSERT_EQ(state.stage, 1u);
  go_back_to(kept, state);
  EXPECT_EQ(state.stage, 0u);
  EXPECT_EQ(state.goals, kept.goals);
  EXPECT_EQ(state.completed_s, (std::vector<double>{-1, -1}));
  EXPECT_EQ(state.errors.size(), 1u);
  // What was over stays over.
  ScenarioState over = judged({touch_end(1, 0), touch_end(2, 1)});
  over.over = true;
  go_back_to(kept, over);
  EXPECT_EQ(over.stage, 1u);
}

TEST(Judge, ErrorsKeepTheirTimeAndGoOn) {
  const ScenarioState state = judged({at(1, EventKind::kForceUnder, 0, {5, 4, 0.25}),
                                      at(2, EventKind::kForceUnder, 0, {5, 4, 0.05}),
                                      at(3, EventKind::kForceUnder, 0, {5, 3, 0.5})});
  ASSERT_EQ(state.errors.size(), 1u);
  EXPECT_DOUBLE_EQ(state.errors[0].at_s, 0.75);
  EXPECT_EQ(state.errors[0].bone, 0u);
  EXPECT_FALSE(state.over);
}

TEST(Judge, ACriticalErrorEndsTheAttempt) {
  const ScenarioState state =
      judged({at(1, EventKind::kImpact, 1, {150, 0, 0}), touch_end(2, 0), touch_end(3, 1)});
  EXPECT_TRUE(state.over);
  EXPECT_EQ(state.stage, 0u);
}

TEST(Judge, WhatWasLeftOutIsFoundAtTheEnd) {
  const ScenarioPlan plan = plan_two();
  ScenarioState state = begin_scenario(plan);
  judge(plan, at(1, EventKind::kContactBegin, 1), 0.001, state);
  finish_scenario(plan, 9, state);
  ASSERT_EQ(state.errors.size(), 1u);
  EXPECT_EQ(state.errors[0].bone, 0u);
  EXPECT_DOUBLE_EQ(state.errors[0].at_s, 9);
}

// Two tunnels of which one may be at fault.
const char* const kLookText = R"(format = 1
name = "look"
title = "Look"
text = "Look."
version = 1
anatomy = "wrist"

[[stages]]
name = "mend"
title = "A"
instruction = "Touch what is at fault."
[[stages.goals]]
rule = "touched"
bones = ["radius"]
unless = "tunnel=sound"
[[stages.goals]]
rule = "touched"
bones = ["lunate"]
unless = "socket=sound"

[[errors]]
name = "too_much"
title = "Touched what is sound"
severity = "major"
consequence = "-"
source = "D"
rule = "struck"
bones = ["radius"]
when = "tunnel=sound"

[[errors]]
name = "missed"
title = "Missed"
severity = "major"
consequence = "-"
source = "D"
rule = "fault_missed"

[[errors]]
name = "blamed"
title = "Blamed"
severity = "major"
consequence = "-"
source = "D"
rule = "sound_blamed"

[[asks]]
finding = "tunnel"
title = "Tunnel"
grades = ["sound", "front", "back"]

[[asks]]
finding = "socket"
title = "Socket"
grades = ["sound", "steep"]
)";

class SecondLook : public ::testing::Test {
 protected:
  SecondLook() { plan_for("sound", "steep"); }
  void plan_for(const std::string& tunnel, const std::string& socket) {
    auto scenario = parse_scenario(kLookText, "look.toml");
    ASSERT_TRUE(scenario) << scenario.error().message();
    case_ = testing::named_case({"radius", "lunate"});
    case_.findings = {{"tunnel", tunnel, ""}, {"socket", socket, ""}};
    auto plan = plan_scenario(*scenario, case_);
    ASSERT_TRUE(plan) << plan.error().message();
    plan_ = std::move(*plan);
    state_ = begin_scenario(plan_);
  }
  std::vector<std::string> errors_of(const StatedFindings& stated) {
    ScenarioState state = state_;
    finish_scenario(plan_, 9, state, grade_findings(plan_.scenario.asks, case_, stated));
    std::vector<std::string> names;
    for (const MadeError& made : state.errors)
      names.push_back(plan_.scenario.errors[made.error].name);
    return names;
  }
  Case case_;
  ScenarioPlan plan_;
  ScenarioState state_;
};

TEST_F(SecondLook, OnlyWhatIsAtFaultIsToBeMended) {
  judge(plan_, touch_end(1, 0), 0.001, state_);
  EXPECT_FALSE(state_.over) << "of the sound one";
  judge(plan_, touch_end(2, 1), 0.001, state_);
  EXPECT_TRUE(state_.over);
}

TEST_F(SecondLook, WhereNothingIsAtFaultItIsDoneAtOnce) {
  plan_for("sound", "sound");
  EXPECT_FALSE(state_.over);
  judge(plan_, at(0.1, EventKind::kImpact, 1), 0.001, state_);
  EXPECT_TRUE(state_.over);
}

TEST_F(SecondLook, AnErrorIsMadeWithThosePatientsAlone) {
  judge(plan_, at(1, EventKind::kImpact, 0, {2000, 0, 0}), 0.001, state_);
  EXPECT_EQ(state_.errors.size(), 1u);
  plan_for("front", "steep");
  judge(plan_, at(1, EventKind::kImpact, 0, {2000, 0, 0}), 0.001, state_);
  EXPECT_TRUE(state_.errors.empty());
}

TEST_F(SecondLook, WhatIsStatedIsJudgedAtTheEnd) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(errors_of({{"tunnel", "sound"}, {"socket", "steep"}}), Names{});
  EXPECT_EQ(errors_of({{"tunnel", "sound"}, {"socket", "sound"}}), Names{"missed"});
  EXPECT_EQ(errors_of({{"tunnel", "sound"}, {"socket", "none"}}), Names{"missed"});
  EXPECT_EQ(errors_of({{"tunnel", "front"}, {"socket", "steep"}}), Names{"blamed"});
  EXPECT_EQ(errors_of({}), Names{"missed"}) << "who says nothing blames nothing";
  plan_for("front", "steep");
  EXPECT_EQ(errors_of({{"tunnel", "back"}, {"socket", "steep"}}), Names{"missed"});
}

TEST(ToolEvents, OfAPressAreTouchForceAndEnd) {
  ToolEvents maker(2, {{2.0}, 1.0, 0.5});
  std::vector<Event> events;
  for (std::uint64_t n = 1; n <= 100; ++n) {
    ToolState tool = testing::tool_at(n, {0, 0, 0.01 - 1e-4 * double(n)});
    tool.X_WD = tool.X_WP;
    const double force_n = n < 50 ? 0 : n < 80 ? 3 : 1.5;
    if (n >= 50 && n < 90) testing::touch(tool, 1, {0, 0, force_n}, 0.0005);
    maker.add(tool, events);
  }
  std::vector<EventKind> kinds;
  for (const Event& event : events) kinds.push_back(event.kind);
  EXPECT_EQ(kinds, (std::vector<EventKind>{EventKind::kContactBegin, EventKind::kImpact,
                                           EventKind::kForceOver, EventKind::kForceUnder,
                                           EventKind::kContactEnd}));
  EXPECT_NEAR(events[1].values[0], 100, 1e-6);  // 0.1 mm a tick
  EXPECT_NEAR(events[3].values[2], 0.030, 1e-9);
  EXPECT_NEAR(events[4].values[0], 0.040, 1e-9);
  EXPECT_DOUBLE_EQ(events[4].values[1], 3);
  EXPECT_EQ(events[4].subject, 1u);
  EXPECT_EQ(events[4].tick, 90u);
}

}  // namespace
}  // namespace osteon
