#include "osteon/procedure/placing_watch.h"

#include <gtest/gtest.h>

#include "placing_case.h"
#include "placing_rules.h"

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
  PlacingWatch watch(*testing::placing_knee());
  ASSERT_TRUE(watch.plan());
  GraftPlacingState state;
  state.on = true;
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

struct PlacingRuleRig {
  PlacingRuleRig(const std::string& kind, std::map<std::string, double> numbers = {}) {
    EXPECT_NE(find_rule_kind(kind), nullptr) << kind;
    rule.rule.kind = kind;
    rule.rule.numbers = std::move(numbers);
    state.holds.resize(1);
  }
  bool hit(EventKind kind, double value = 0) {
    Event event;
    event.kind = kind;
    event.values = {value, 0, 0};
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

}  // namespace
}  // namespace osteon
