#include "osteon/procedure/placing_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "placing_case.h"
#include "rules/placing_rules.h"

namespace osteon {
namespace {

std::vector<Event> told_of(PlacingWatch& watch, const GraftPlacingState& state) {
  BoneSnapshot bones;
  bones.placing = state;
  std::vector<Event> out;
  watch.add(5, bones, out);
  return out;
}

TEST(PlacingWatch, TellsOnceWhatHappened) {
  PlacingWatch watch;
  EXPECT_FALSE(watch.plan());
  GraftPlacingState state;
  state.on = true;
  state.plan = *find_placing(*testing::placing_knee());
  EXPECT_TRUE(told_of(watch, state).empty());
  const auto expect = [&](EventKind kind) {
    const auto told = told_of(watch, state);
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].kind, kind);
    EXPECT_TRUE(told_of(watch, state).empty());
  };
  state.phase = PlacingPhase::kThreadInside;
  expect(kThreadLaid);
  state.phase = PlacingPhase::kThreadHeld;
  EXPECT_TRUE(told_of(watch, state).empty());
  state.phase = PlacingPhase::kThreadInside;  // let go in the joint: not laid anew
  EXPECT_TRUE(told_of(watch, state).empty());
  state.phase = PlacingPhase::kEmpty;
  state.lost = 1;
  expect(kThreadLost);
  state.phase = PlacingPhase::kThreadOut;
  expect(kThreadOut);
  state.let_go_early = 1;
  expect(kButtonLetGo);
  state.phase = PlacingPhase::kTurned;
  state.gap_m = 0.003;
  state.drawn_m = watch.plan()->button_out_m() + 0.009;
  const auto told = told_of(watch, state);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].kind, kButtonTurned);
  EXPECT_NEAR(told[0].values[0], 3, 1e-9);
  EXPECT_NEAR(told[0].values[2], 9, 1e-9);
}

// Bent with the graft in it, its lengths come by tens of degrees; the screw is told once.
TEST(PlacingWatch, TellsBendingAndTheScrewAndGathersLengths) {
  PlacingWatch watch;
  BoneSnapshot bones = rest_snapshot(*testing::placing_knee());
  bones.placing.on = true;
  bones.placing.plan = *find_placing(*testing::placing_knee());
  bones.placing.phase = PlacingPhase::kTurned;
  bones.placing.tension_n = 80;
  bones.bend.on = true;
  std::vector<Event> out;
  watch.add(1, bones, out);  // it turned
  out.clear();
  bones.bend.now_deg = 60;
  watch.add(2, bones, out);
  bones.bones[1].X_WB.p.z() -= 0.004;
  bones.bend.now_deg = 80.2;
  bones.bend.cycles = 1;
  watch.add(3, bones, out);
  watch.add(4, bones, out);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].kind, kKneeCycled);
  EXPECT_EQ(out[0].values[0], 1);
  EXPECT_EQ(out[0].values[1], 80);
  EXPECT_NEAR(watch.bent().lengths_m[6], 0.030, 1e-9);
  EXPECT_NEAR(watch.bent().lengths_m[8], 0.034, 1e-9);
  EXPECT_NEAR(excursion_m(watch.bent()), 0.004, 1e-9);
  out.clear();
  PlacingScrew& screw = bones.placing.screw;
  screw = {
      1, Vec3::Zero(), Vec3(0, std::sin(0.2), -std::cos(0.2)), 0.009, 0.025, 0.022, true, 75, 30,
      21};
  watch.add(5, bones, out);
  watch.add(6, bones, out);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].kind, kScrewIn);
  EXPECT_NEAR(out[0].values[0], 22, 1e-9);
  EXPECT_NEAR(out[0].values[1], 0.2 * 180 / 3.14159265358979, 1e-6);
  EXPECT_EQ(out[0].values[2], 75);
  EXPECT_EQ(out[1].kind, kGraftFixed);
  EXPECT_EQ(out[1].values[0], 30);
  EXPECT_EQ(out[1].values[1], 21);
  EXPECT_NEAR(out[1].values[2], 1, 1e-9);
}

struct PlacingRuleRig {
  PlacingRuleRig(const std::string& kind, std::map<std::string, double> numbers = {}) {
    EXPECT_NE(find_rule_kind(kind), nullptr) << kind;
    rule.rule.kind = kind;
    rule.rule.numbers = std::move(numbers);
    state.holds.resize(1);
  }
  bool hit(EventKind kind, double value = 0, double second = 0, double third = 0) {
    Event event;
    event.kind = kind;
    event.values = {value, second, third};
    std::optional<RuleHit> made;
    EXPECT_TRUE(step_placing_rule(rule, event, 0.001, state, made));
    return made.has_value();
  }
  PlannedRule rule;
  RuleState state;
};

TEST(PlacingRules, GoalsAreMetByTheirEventAlone) {
  const std::pair<const char*, EventKind> goals[] = {
      {"thread_laid", kThreadLaid}, {"thread_out", kThreadOut}, {"button_turned", kButtonTurned}};
  for (const auto& [name, kind] : goals) {
    PlacingRuleRig rig(name);
    for (const EventKind other : {kThreadLost, kButtonLetGo}) rig.hit(other);
    EXPECT_FALSE(rig.state.met) << name;
    rig.hit(kind);
    EXPECT_TRUE(rig.state.met) << name;
  }
}

TEST(PlacingRules, ErrorsAreMadeByTheirEventAndWithinTheirRange) {
  EXPECT_TRUE(PlacingRuleRig("thread_lost").hit(kThreadLost));
  EXPECT_FALSE(PlacingRuleRig("thread_lost").hit(kThreadOut));
  EXPECT_TRUE(PlacingRuleRig("button_let_go").hit(kButtonLetGo));
  PlacingRuleRig tissue("tissue_under_button", {{"least_mm", 1}, {"most_mm", 8}});
  EXPECT_FALSE(tissue.hit(kButtonTurned, 0.9));
  EXPECT_TRUE(tissue.hit(kButtonTurned, 1));
  EXPECT_FALSE(tissue.hit(kButtonTurned, 8));
  EXPECT_FALSE(tissue.hit(kButtonLetGo, 3));
}

TEST(PlacingRules, TheScrewIsJudgedByHowItWentIn) {
  PlacingRuleRig in("screw_in");
  in.hit(kGraftFixed);
  EXPECT_FALSE(in.state.met);
  in.hit(kScrewIn);
  EXPECT_TRUE(in.state.met);
  PlacingRuleRig cycled("knee_cycled", {{"times", 20}, {"tension_n", 20}});
  cycled.hit(kKneeCycled, 19, 90);
  cycled.hit(kKneeCycled, 20, 0);
  EXPECT_FALSE(cycled.state.met);
  cycled.hit(kKneeCycled, 21, 90);
  EXPECT_TRUE(cycled.state.met);
  PlacingRuleRig diverges("screw_diverges", {{"most_deg", 15}});
  EXPECT_FALSE(diverges.hit(kScrewIn, 25, 14, 90));
  EXPECT_TRUE(diverges.hit(kScrewIn, 25, 16, 90));
  PlacingRuleRig shallow("screw_shallow", {{"least_mm", 20}});
  EXPECT_TRUE(shallow.hit(kScrewIn, 19, 0, 90));
  EXPECT_FALSE(shallow.hit(kScrewIn, 21, 0, 90));
  PlacingRuleRig tension("tension_outside", {{"least_n", 40}, {"most_n", 150}});
  EXPECT_TRUE(tension.hit(kScrewIn, 25, 0, 39));
  EXPECT_FALSE(tension.hit(kScrewIn, 25, 0, 90));
  EXPECT_TRUE(tension.hit(kScrewIn, 25, 0, 151));
  PlacingRuleRig cycles("cycles_under", {{"least", 20}});
  EXPECT_TRUE(cycles.hit(kGraftFixed, 30, 19));
  EXPECT_FALSE(cycles.hit(kGraftFixed, 30, 20));
}

}  // namespace
}  // namespace osteon
