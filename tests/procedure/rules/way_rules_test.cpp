#include <gtest/gtest.h>

#include <cmath>

#include "../report_fixtures.h"
#include "osteon/procedure/judge.h"
#include "osteon/procedure/polyline.h"
#include "osteon/procedure/tip_watch.h"

namespace osteon {
namespace {

// Four marks, 10 mm apart, along x: as a way, or as two pairs.
Case marked_line() {
  Case c = testing::named_case({"plate"});
  for (int i = 0; i < 4; ++i)
    c.landmarks.push_back({"m" + std::to_string(i), Vec3(0.01 * i, 0, 0)});
  return c;
}

struct TipPlayer {
  TipPlayer(const std::string& goal, const std::string& error) : c(marked_line()) {
    const std::string marks = "\nmarks = [\"m0\", \"m1\", \"m2\", \"m3\"]\n";
    const std::string text =
        "format = 1\nname = \"w\"\ntitle = \"W\"\ntext = \"W\"\nversion = 1\nanatomy = \"wrist\"\n"
        "[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n[[stages.goals]]\nrule = " +
        goal + marks +
        "[[errors]]\nname = \"e\"\ntitle = \"E\"\nseverity = \"major\"\nconsequence = \"c\"\n"
        "source = \"D\"\nrule = " +
        error + marks;
    auto scenario = parse_scenario(text, "w.toml");
    EXPECT_TRUE(scenario) << scenario.error().message();
    plan = *plan_scenario(*scenario, c);
    state = begin_scenario(plan);
  }
  void tip_mm(double x, double y = 0) {
    std::vector<Event> events;
    tick += 10;
    ToolState tool = testing::tool_at(tick, Vec3(x, y, 0) / 1000);
    tell_tip(tool, 0, 0.001, events);
    for (const Event& event : events) judge(plan, event, 0.001, state);
  }
  void go_mm(double from, double to, double y = 0) {
    const double step = from < to ? 0.2 : -0.2;
    for (double x = from; (to - x) * step > 0; x += step) tip_mm(x, y);
    tip_mm(to, y);
  }
  Case c;
  ScenarioPlan plan;
  ScenarioState state;
  std::uint64_t tick = 0;
};

const char* const kReach = "\"reached_in_order\"\nnear_mm = 2";
const char* const kStray = "\"strayed\"\noff_mm = 3\nfor_s = 0.2";
const char* const kPass = "\"passed_in_order\"\nnear_mm = 3";
const char* const kOutOfOrder = "\"passed_out_of_order\"\nnear_mm = 3";

TEST(Polyline, DistanceIsToTheNearestPiece) {
  EXPECT_TRUE(std::isinf(distance_to_polyline({}, Vec3::Zero())));
  const std::vector<Vec3> one{Vec3(3, 4, 0)};
  EXPECT_DOUBLE_EQ(distance_to_polyline(one, Vec3::Zero()), 5);
  const std::vector<Vec3> way{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0)};
  EXPECT_DOUBLE_EQ(distance_to_polyline(way, Vec3(1, -1, 0)), 1);
  EXPECT_DOUBLE_EQ(distance_to_polyline(way, Vec3(5, 6, 0)), 5);
}

TEST(TipWatch, TellsAHundredTimesASecondAndNothingOfNoPose) {
  std::vector<Event> events;
  for (std::uint64_t n = 1; n <= 1000; ++n)
    tell_tip(testing::tool_at(n, Vec3(1, 2, 3)), 1, 0.001, events);
  ASSERT_EQ(events.size(), 100u);
  EXPECT_EQ(events[0].p_W, Vec3(1, 2, 3));
  EXPECT_EQ(events[0].hand, 1);
  tell_tip(testing::tool_at(2000, Vec3(std::nan(""), 0, 0)), 1, 0.001, events);
  EXPECT_EQ(events.size(), 100u);
}

TEST(WayRules, MarksAreReachedInTheirOrderAlone) {
  TipPlayer backwards(kReach, kStray);
  for (const double x : {30.0, 20.0, 10.0, 0.0}) backwards.tip_mm(x);
  EXPECT_FALSE(backwards.state.over);
  TipPlayer beside(kReach, kStray);
  for (const double x : {0.0, 10.0, 20.0, 30.0}) beside.tip_mm(x, 2.1);
  EXPECT_FALSE(beside.state.over);
  TipPlayer forwards(kReach, kStray);
  for (const double x : {0.0, 10.0, 20.0, 30.0}) forwards.tip_mm(x, 1.9);
  EXPECT_TRUE(forwards.state.over);
  EXPECT_TRUE(forwards.state.errors.empty());
}

TEST(WayRules, StrayingCountsBetweenTheFirstMarkAndTheLastAndOnceItLasts) {
  TipPlayer p(kReach, kStray);
  for (int i = 0; i < 50; ++i) p.tip_mm(5, 20);  // the way has not begun
  p.go_mm(0, 15);
  for (int i = 0; i < 15; ++i) p.tip_mm(15, 4);  // 0.15 s are allowed
  p.go_mm(15, 16);
  EXPECT_TRUE(p.state.errors.empty());
  for (int i = 0; i < 80; ++i) p.tip_mm(16, 3.1);
  ASSERT_EQ(p.state.errors.size(), 1u);
  p.go_mm(16, 29);
  EXPECT_TRUE(p.state.over);
  EXPECT_EQ(p.state.errors.size(), 1u);
}

TEST(WayRules, APairIsPassedThroughItsMiddleAndNotAround) {
  TipPlayer around(kPass, kOutOfOrder);
  around.go_mm(-5, 12, 3.5);
  around.go_mm(12, 35, 0);  // comes from behind the first pair's entry: that one is still open
  EXPECT_FALSE(around.state.goals[0].done[0]);
  TipPlayer back(kPass, kOutOfOrder);
  back.go_mm(-5, 8);
  back.go_mm(8, -1);
  back.tip_mm(12, 9);  // out of the hole and round the plate
  back.go_mm(12, 15);
  EXPECT_FALSE(back.state.goals[0].done[0]);
  TipPlayer through(kPass, kOutOfOrder);
  through.go_mm(-5, 11);
  EXPECT_TRUE(through.state.goals[0].done[0] && through.state.goals[0].done[1]);
  EXPECT_FALSE(through.state.over);
  through.go_mm(15, 31);
  EXPECT_TRUE(through.state.over);
  EXPECT_TRUE(through.state.errors.empty());
}

TEST(WayRules, APairBeforeItsTurnIsAnErrorAndDoesNotCount) {
  TipPlayer p(kPass, kOutOfOrder);
  p.go_mm(15, 31);
  ASSERT_EQ(p.state.errors.size(), 1u);
  EXPECT_FALSE(p.state.over);
  p.go_mm(-5, 11);
  p.go_mm(15, 31);
  EXPECT_TRUE(p.state.over);
  EXPECT_EQ(p.state.errors.size(), 1u);
}

TEST(WayRules, NeedMarksThatTheCaseHas) {
  const std::string text =
      "format = 1\nname = \"w\"\ntitle = \"W\"\ntext = \"W\"\nversion = 1\nanatomy = \"wrist\"\n"
      "[[stages]]\nname = \"s\"\ntitle = \"S\"\ninstruction = \"I\"\n[[stages.goals]]\n";
  EXPECT_FALSE(parse_scenario(text + "rule = \"reached_in_order\"\n", "w.toml"));
  const auto unknown =
      parse_scenario(text + "rule = \"reached_in_order\"\nmarks = [\"m9\"]\n", "w.toml");
  ASSERT_TRUE(unknown);
  EXPECT_FALSE(plan_scenario(*unknown, marked_line()));
  // Of a part that shall go the bone is asked for as well.
  EXPECT_FALSE(parse_scenario(text + "rule = \"removed\"\nmarks = [\"m0\"]\n", "w.toml"));
  const auto no_bone =
      parse_scenario(text + "rule = \"removed\"\nmarks = [\"m0\"]\nbones = [\"disc\"]\n", "w.toml");
  ASSERT_TRUE(no_bone);
  EXPECT_FALSE(plan_scenario(*no_bone, marked_line()));
}

}  // namespace
}  // namespace osteon
