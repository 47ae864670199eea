#include "rules/portal_rules.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "osteon/procedure/portal_watch.h"

namespace osteon {
namespace {

struct PortalRuleRig {
  explicit PortalRuleRig(const std::string& kind, std::map<std::string, double> numbers = {}) {
    const RuleKind* row = find_rule_kind(kind);
    EXPECT_NE(row, nullptr) << kind;
    if (!row) return;
    rule.rule.kind = kind;
    rule.about = row->about;
    rule.bones = {3, 5};
    for (const RuleNumber& number : row->numbers)
      rule.rule.numbers[std::string(number.name)] = number.usual;
    for (const auto& [name, value] : numbers) rule.rule.numbers[name] = value;
    state.done.resize(2);
    state.holds.resize(2);
  }
  // As the judge does.
  bool hit(EventKind kind, std::uint32_t mark, double a = 0, double b = 0, double c = 0) {
    Event event;
    event.kind = kind;
    event.hand = 0;
    event.subject_kind = SubjectKind::kLandmark;
    event.subject = mark;
    event.values = {a, b, c};
    return step_rule(rule, event, 0.001, state).has_value();
  }
  PlannedRule rule;
  RuleState state;
};

TEST(PortalRules, TheGoalIsMetWhenEachPortalIsMadeNearItsMark) {
  PortalRuleRig rig("portal_made");
  rig.hit(kPortalPlaced, 3, 4, 4);  // 5.7 mm
  rig.hit(kPortalPlaced, 4, 0, 0);  // of another mark
  rig.hit(kPortalWay, 3, 0, 0);
  EXPECT_FALSE(rig.state.met);
  rig.hit(kPortalPlaced, 3, -3, 4);
  EXPECT_FALSE(rig.state.met);
  rig.hit(kPortalPlaced, 5, 0, 1);
  EXPECT_TRUE(rig.state.met);
}

TEST(PortalRules, ANeedleCountsNearItsMarkAndSeen) {
  PortalRuleRig rig("needle_in");
  rig.hit(kNeedleIn, 3, 4, 4, 1);  // 5.7 mm
  rig.hit(kNeedleIn, 3, 1, 1, 0);  // nobody saw it
  rig.hit(kPortalPlaced, 3, 0, 0, 1);
  rig.hit(kNeedleIn, 5, 0, 1, 1);
  EXPECT_FALSE(rig.state.met);
  rig.hit(kNeedleIn, 3, -3, 4, 1);
  EXPECT_TRUE(rig.state.met);
}

TEST(PortalRules, OutsideIsBySideAndOnlyTheNamedSidesCount) {
  PortalRuleRig low("portal_outside", {{"down_mm", 5}});
  EXPECT_FALSE(low.hit(kPortalPlaced, 3, -5, 0));
  EXPECT_FALSE(low.hit(kPortalPlaced, 3, 9, 9));
  EXPECT_FALSE(low.hit(kPortalPlaced, 3, 0, -9));
  EXPECT_TRUE(low.hit(kPortalPlaced, 3, -5.1, 0));
  EXPECT_FALSE(low.hit(kPortalPlaced, 4, -9, 0));
  PortalRuleRig high("portal_outside", {{"up_mm", 5}});
  EXPECT_TRUE(high.hit(kPortalPlaced, 3, 6, 0));
  PortalRuleRig middle("portal_outside", {{"middle_mm", 5}});
  EXPECT_TRUE(middle.hit(kPortalPlaced, 5, 0, 6));
  EXPECT_FALSE(middle.hit(kPortalPlaced, 5, 0, -6));
  PortalRuleRig aside("portal_outside", {{"aside_mm", 5}});
  EXPECT_TRUE(aside.hit(kPortalPlaced, 5, 0, -6));
  EXPECT_FALSE(aside.hit(kPortalPlaced, 5, 0, 6));
}

TEST(PortalRules, PiercingIsAnErrorAndACutIsNone) {
  PortalRuleRig rig("portal_pierced");
  EXPECT_FALSE(rig.hit(kPortalWay, 3, 0, 1));
  EXPECT_FALSE(rig.hit(kPortalPlaced, 3, 1, 1));
  EXPECT_TRUE(rig.hit(kPortalWay, 3, 1, 1));
}

TEST(PortalRules, WhatNoScopeHasSeenIsAnError) {
  PortalRuleRig rig("portal_unseen");
  EXPECT_FALSE(rig.hit(kPortalWay, 5, 1, 1));
  EXPECT_FALSE(rig.hit(kPortalPlaced, 5, 0, 0));
  EXPECT_TRUE(rig.hit(kPortalWay, 5, 0, 0));
}

}  // namespace
}  // namespace osteon
