#include "window/controllers/sessions/exercise_facts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cases/open_case.h"
#include "exercises/scenario_files.h"
#include "osteon/base/turn.h"
#include "osteon/scene/marks_now.h"

namespace osteon {
namespace {

using Facts = std::vector<ExerciseModel::Told>;

std::string value_of(const Facts& facts, const std::string& name) {
  for (const auto& fact : facts)
    if (fact.name == name) return fact.value;
  return {};
}

Facts facts_seen(const Case& the_case, const GraftBenchState& bench) {
  GraftWatch watch(the_case);
  BoneSnapshot bones;
  bones.bench = bench;
  std::vector<Event> out;
  watch.add(1, bones, out);
  return facts_of(watch);
}

Facts facts_seen(const GraftPlacingState& placing) {
  PlacingWatch watch;
  BoneSnapshot bones;
  bones.placing = placing;
  std::vector<Event> out;
  watch.add(1, bones, out);
  return facts_of(watch);
}

TEST(ExerciseFacts, ABenchTellsHowFarEachTendonHasCome) {
  const auto bench_case = open_case("builtin:graft_bench");
  ASSERT_TRUE(bench_case) << bench_case.error().message();
  GraftBenchState bench;
  bench.on = true;
  const Facts before = facts_seen(**bench_case, bench);
  EXPECT_EQ(value_of(before, "Semitendinosus"), "");
  EXPECT_EQ(value_of(before, "Graft's cylinder"), "");
  bench.tendons[0].front_m = 0.1204;
  EXPECT_EQ(value_of(facts_seen(**bench_case, bench), "Semitendinosus"), "120 mm stripped");
  EXPECT_EQ(value_of(facts_seen(**bench_case, bench), "Gracilis"), "");
  bench.tendons[0].front_m = 0.302;
  bench.tendons[0].stripped = true;
  EXPECT_EQ(value_of(facts_seen(**bench_case, bench), "Semitendinosus"), "out, 302 mm");
  bench.tendons[0].stitches = 0b1;
  EXPECT_EQ(value_of(facts_seen(**bench_case, bench), "Semitendinosus, thread"), "1 pass");
  bench.tendons[0].stitches = 0b1011;
  bench.tendons[0].folds = 3;
  bench.tendons[1].amputated = true;
  bench.passed_m = 0.0085;
  bench.tension_n = 79.6;
  bench.creep_s = 300;
  const Facts then = facts_seen(**bench_case, bench);
  EXPECT_EQ(value_of(then, "Semitendinosus, thread"), "3 passes");
  EXPECT_EQ(value_of(then, "Semitendinosus"), "3 strands");
  EXPECT_EQ(value_of(then, "Gracilis"), "cut off");
  EXPECT_EQ(value_of(then, "Graft's cylinder"), "8.5 mm");
  EXPECT_EQ(value_of(then, "Board's pull"), "80 N");
  EXPECT_EQ(value_of(then, "Graft stretched"), "5 min");
  bench.loop_m = 0.02;  // it is made
  EXPECT_EQ(value_of(facts_seen(**bench_case, bench), "Semitendinosus"), "");
}

TEST(ExerciseFacts, TendonsThatAreToBeStrippedTellHowManyOfTheirBandsAreCut) {
  const auto bench_case = open_case("builtin:graft_bench");
  ASSERT_TRUE(bench_case) << bench_case.error().message();
  GraftBenchState bench;
  bench.on = true;
  bench.tendons[0].bands_cut = 0b10;
  const auto bands = [&] {
    BoneSnapshot bones;
    bones.bench = bench;
    GraftWatch watch(**bench_case);
    std::vector<Event> out;
    watch.add(1, bones, out);
    return bands_of(watch);
  };
  EXPECT_EQ(value_of(bands(), "Semitendinosus, bands"), "1 of 2 cut");
  EXPECT_EQ(value_of(bands(), "Gracilis, bands"), "0 of 1 cut");
  bench.tendons[0].stripped = true;
  EXPECT_EQ(value_of(bands(), "Semitendinosus, bands"), "");
  bench.tendons[1].amputated = true;
  EXPECT_TRUE(bands().empty());
}

TEST(ExerciseFacts, WhileTendonsAreToBeFoundTheFasciaTellsHowFarItIsOpen) {
  const auto bench_case = open_case("builtin:graft_bench");
  ASSERT_TRUE(bench_case) << bench_case.error().message();
  GraftWatch watch(**bench_case);
  BoneSnapshot bones;
  bones.bench = fresh_bench(*watch.plan());
  bones.bench.slit = 0xfffff;
  bones.bench.tendons[1].found = true;
  std::vector<Event> out;
  watch.add(1, bones, out);
  EXPECT_EQ(value_of(fascia_of(watch), "Fascia, open"), "20 of 36 mm");
  EXPECT_EQ(value_of(fascia_of(watch), "Semitendinosus"), "under the fascia");
  EXPECT_EQ(value_of(fascia_of(watch), "Gracilis"), "found");
}

TEST(ExerciseFacts, PlacingTellsWhatBoneHides) {
  EXPECT_TRUE(facts_seen(GraftPlacingState{}).empty()) << "there are no tunnels";
  GraftPlacingState state;
  state.on = true;
  state.plan.femur.outer_B = Vec3(0.04, 0, 0);
  EXPECT_TRUE(facts_seen(state).empty());
  state.pin_m = 0.0234;
  EXPECT_EQ(value_of(facts_seen(state), "Passing pin"), "23 of 50 mm") << "10 mm beyond";
  state.phase = PlacingPhase::kThreadInside;
  EXPECT_EQ(value_of(facts_seen(state), "Passing pin"), "");
  EXPECT_EQ(value_of(facts_seen(state), "Thread"), "through the femur");
  state.phase = PlacingPhase::kThreadHeld;
  EXPECT_EQ(value_of(facts_seen(state), "Thread"), "in the jaws");
  state.phase = PlacingPhase::kThreadOut;
  state.drawn_m = 0.060;
  const auto out_mm = std::to_string(std::lround(1e3 * state.plan.button_out_m()));
  EXPECT_EQ(value_of(facts_seen(state), "Graft drawn in"), "60 of " + out_mm + " mm");
  state.phase = PlacingPhase::kTurned;
  EXPECT_TRUE(facts_seen(state).empty());
  state.screw.in_m = 0.012;
  EXPECT_EQ(value_of(facts_seen(state), "Screw"), "12 mm deep");
  state.phase = PlacingPhase::kEmpty;
  state.pin_m = 0;
  state.lost = 1;
  EXPECT_EQ(value_of(facts_seen(state), "Thread"), "lost");
}

// A scope that looks straight ahead, towards a footprint from the side of its portal.
TEST(ExerciseFacts, ASightTellsWhatIsMissing) {
  const auto knee = open_case(
      "builtin:knee:0:right:acl_tear=midsubstance"
      "#femur=field,tibia=field,fibula=hull,patella=hull,flexion=120,near=100");
  ASSERT_TRUE(knee) << knee.error().message();
  const auto scenario = open_scenario("acl");
  ASSERT_TRUE(scenario) << scenario.error().message();
  const auto plan = plan_scenario(*scenario, **knee);
  ASSERT_TRUE(plan) << plan.error().message();
  ScenarioState state = begin_scenario(*plan);
  while (scenario->stages[state.stage].name != "inspection") ++state.stage;
  state.goals.assign(plan->goals[state.stage].size(), {});
  const BoneSnapshot bones = rest_snapshot(**knee);
  const auto at = [&](const char* name) {
    return place_now(**knee, *find_landmark(**knee, name), bones);
  };
  PlannedHand scope;
  scope.optics = ScopeOptics{0, 0.9};
  const Vec3 mark_W = at("acl_tibia"), back_W = (at("portal_al") - mark_W).normalized();
  const auto told = [&](double away_m, double aside_rad) {
    ToolState tool;
    tool.X_WP.p = mark_W + away_m * back_W;
    const Vec3 across_W = back_W.cross(Vec3::UnitX()).normalized();
    tool.X_WP.q =
        (Quat(Eigen::AngleAxisd(aside_rad, across_W)) * turn_between(Vec3::UnitZ(), back_W))
            .normalized();
    return value_of(
        sights_of(*plan, state, **knee, std::span(&scope, 1), std::span(&tool, 1), bones),
        "ACL tibia");
  };
  EXPECT_EQ(told(0.015, 0), "hold it");
  EXPECT_EQ(told(0.015, 0.6), "not central enough");
  EXPECT_EQ(told(0.015, 1.0), "") << "out of the picture";
  EXPECT_EQ(told(0.002, 0), "2.0 mm, too near");
  EXPECT_EQ(told(0.035, 0), "35.0 mm, too far");
  EXPECT_EQ(told(-0.03, 3.14159), "behind bone");
  for (auto& goal : state.goals) goal.met = true;
  EXPECT_EQ(told(0.015, 0), "") << "it has been seen";
}

// Goals without a mark are named in the list of what is left, too.
TEST(ExerciseFacts, GoalsThatNameNoMarkHaveWords) {
  const auto scenario = open_scenario("acl");
  ASSERT_TRUE(scenario) << scenario.error().message();
  std::size_t named = 0;
  for (const ScenarioStage& stage : scenario->stages)
    for (const Rule& goal : stage.goals)
      if (stage.goals.size() > 1 && goal.marks.empty() && goal.subjects.empty()) {
        EXPECT_NE(words_of_goal(goal.kind), "") << stage.name << ": " << goal.kind;
        ++named;
      }
  EXPECT_GE(named, 7u);
  EXPECT_EQ(words_of_goal("no_such_rule"), "");
}

TEST(ExerciseFacts, AnAttemptIsWholeOnceEveryStageIsDone) {
  Outcome outcome;
  outcome.stages = {{"first", 3.0}, {"second", std::nullopt}};
  EXPECT_FALSE(is_whole(outcome));
  outcome.stages[1].completed_s = 9;
  EXPECT_TRUE(is_whole(outcome));
}

TEST(ExerciseFacts, AVerdictSaysWhy) {
  Outcome outcome;
  outcome.verdict = Verdict::kPassed;
  EXPECT_EQ(why_of(outcome, 70), "");
  outcome.verdict = Verdict::kNotPassed;
  outcome.score = Score{40, 31, 49};
  EXPECT_NE(why_of(outcome, 70).find("70 points are needed"), std::string::npos);
  EXPECT_EQ(why_of(outcome, {}), "") << "there is no standard";
  outcome.verdict = Verdict::kUndecided;
  EXPECT_NE(why_of(outcome, 70).find("includes the 70"), std::string::npos);
  outcome.verdict = Verdict::kNotPassed;
  outcome.errors = {{"slip", Severity::kMinor, 0, 0, ""}};
  EXPECT_NE(why_of(outcome, 70).find("points"), std::string::npos) << "a minor error lets pass";
  outcome.errors.push_back({"plunged", Severity::kMajor, 0, 0, ""});
  EXPECT_NE(why_of(outcome, 70).find("error"), std::string::npos);
  EXPECT_EQ(why_of(outcome, 70).find("points"), std::string::npos);
  outcome.stages = {{"first", 3.0}, {"second", std::nullopt}};
  EXPECT_EQ(why_of(outcome, 70), "Not every stage was done.");
}

}  // namespace
}  // namespace osteon
