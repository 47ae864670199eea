#include "osteon/surgeon/way_surgeon.h"

#include <gtest/gtest.h>

#include "osteon/procedure/tip_watch.h"

namespace osteon {
namespace {

// Three marks of a groove, and the rules of a maze.
Case groove() {
  Case c;
  c.name = "groove";
  const Vec3 places[] = {{0, 0, 0}, {0.02, 0, 0}, {0.02, 0.02, 0}};
  for (int i = 0; i < 3; ++i) c.landmarks.push_back({"m" + std::to_string(i), places[i]});
  return c;
}

ScenarioPlan maze_plan(const Case& c) {
  const std::string marks = "\nmarks = [\"m0\", \"m1\", \"m2\"]\n";
  auto scenario = parse_scenario(
      "format = 1\nname = \"w\"\ntitle = \"W\"\ntext = \"W\"\nversion = 1\nanatomy = \"wrist\"\n"
      "[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n[[stages.goals]]\nrule = "
      "\"reached_in_order\"" +
          marks +
          "[[errors]]\nname = \"left\"\ntitle = \"E\"\nseverity = \"major\"\nconsequence = \"c\"\n"
          "source = \"D\"\nrule = \"strayed\"" +
          marks,
      "w.toml");
  EXPECT_TRUE(scenario) << scenario.error().message();
  return *plan_scenario(*scenario, c);
}

const Vec3 kPortal(-0.05, 0.03, 0.055);

ScenarioState played(const Skill& skill) {
  const Case c = groove();
  const ScenarioPlan plan = maze_plan(c);
  WaySurgeon surgeon(plan_way(plan, c, skill, {kPortal, 0.00075}), skill, kPortal);
  ScenarioState state = begin_scenario(plan);
  ToolState tool;
  for (; tool.tick < 60000 && !surgeon.done();) {
    ++tool.tick;
    tool.X_WP = surgeon.step(0.001);
    EXPECT_TRUE(is_finite(tool.X_WP));
    // The shaft points at the portal, but for the tremor.
    EXPECT_LT((kPortal - tool.X_WP.p).normalized().cross(tool.X_WP.rotate(Vec3::UnitZ())).norm(),
              0.01);
    surgeon.feel(Vec3::Zero());
    std::vector<Event> events;
    tell_tip(tool, 0, 0.001, events);
    for (const Event& event : events) judge(plan, event, 0.001, state);
  }
  EXPECT_TRUE(surgeon.done());
  return state;
}

TEST(WaySurgeon, TheExpertGoesFromMarkToMark) {
  const ScenarioState state = played(expert_skill());
  EXPECT_TRUE(state.over);
  EXPECT_TRUE(state.errors.empty());
}

TEST(WaySurgeon, WhoSetsOutToStrayDoesAndThenGoesOn) {
  Skill bad = expert_skill();
  bad.fault = "strayed";
  const ScenarioState state = played(bad);
  EXPECT_TRUE(state.over);
  EXPECT_EQ(state.errors.size(), 1u);
}

TEST(WaySurgeon, ThereIsNoWayWhereNoGoalAsksForOne) {
  const Case c = groove();
  ScenarioPlan plan = maze_plan(c);
  plan.goals.clear();
  const Skill expert = expert_skill();
  EXPECT_TRUE(plan_way(plan, c, expert, {kPortal, 0.00075}).empty());
  WaySurgeon idle({}, expert, kPortal);
  EXPECT_TRUE(idle.done());
}

TEST(WaySurgeon, PowerAndJawAreCommandsAsALegBegins) {
  WayLeg here, there;
  here.power = 0.5;
  there.to_W = {0.01, 0, 0};
  there.jaw = 1;
  WaySurgeon surgeon({here, there}, expert_skill(), kPortal);
  (void)surgeon.step(0.001);
  const Command first = surgeon.command();
  EXPECT_EQ(first.kind, CommandKind::kPower);
  EXPECT_EQ(first.value, 0.5);
  EXPECT_EQ(surgeon.command().kind, CommandKind::kNone);
  while (!surgeon.done() && surgeon.touched() == 0) {
    (void)surgeon.step(0.001);
    const Command next = surgeon.command();
    if (next.kind == CommandKind::kNone) continue;
    EXPECT_EQ(next.kind, CommandKind::kJaw);
    return;
  }
  FAIL() << "the jaw was never told";
}

}  // namespace
}  // namespace osteon
