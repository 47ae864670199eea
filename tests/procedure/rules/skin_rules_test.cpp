#include "rules/skin_rules.h"

#include <gtest/gtest.h>

#include <array>

#include "osteon/procedure/skin_watch.h"
#include "osteon/scene/soft_events.h"

namespace osteon {
namespace {

struct SkinRuleRig {
  SkinRuleRig(const std::string& kind, const char* number, double value) {
    const RuleKind* row = find_rule_kind(kind);
    EXPECT_NE(row, nullptr) << kind;
    rule.rule.kind = kind;
    rule.about = row->about;
    rule.heeds = row->heeds;
    rule.rule.numbers[number] = value;
    state.holds.resize(1);
  }
  // As the judge does.
  bool hit(const std::array<double, 3>& values, EventKind kind = kSkinOpened) {
    Event event;
    event.tick = 1500;
    event.kind = kind;
    event.hand = 2;
    event.values = values;
    const auto made = step_rule(rule, event, 0.001, state);
    EXPECT_NEAR(made ? made->at_s : 1.5, 1.5, 1e-9);
    return made.has_value();
  }
  PlannedRule rule;
  RuleState state;
};

TEST(SkinRules, TheGoalIsMetOnceEnoughIsOpenAndStaysMet) {
  SkinRuleRig rig("skin_opened", "least_mm", 25);
  EXPECT_FALSE(rig.hit({60, 0, 0}, kSkinCutEnd));
  EXPECT_FALSE(rig.state.met) << "another event";
  rig.hit({24.9, 0, 0});
  EXPECT_FALSE(rig.state.met);
  rig.hit({25, 30, 30});
  EXPECT_TRUE(rig.state.met);
  rig.hit({3, 0, 0});
  EXPECT_TRUE(rig.state.met);
}

TEST(SkinRules, EachStrokeAsideOrTooDeepIsAnErrorOfItsOwn) {
  SkinRuleRig aside("skin_opened_aside", "most_mm", 12);
  EXPECT_FALSE(aside.hit({30, 12, 9}));
  EXPECT_TRUE(aside.hit({1, 12.1, 0}));
  EXPECT_TRUE(aside.hit({2, 13, 0}));
  SkinRuleRig deep("skin_opened_deep", "most_mm", 2);
  EXPECT_FALSE(deep.hit({30, 20, 2}));
  EXPECT_TRUE(deep.hit({30, 0, 2.1}));
  EXPECT_FALSE(deep.hit({30, 0, 9}, kSkinCutEnd));
}

}  // namespace
}  // namespace osteon
