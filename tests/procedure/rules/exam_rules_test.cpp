#include "rules/exam_rules.h"

#include <gtest/gtest.h>

#include "osteon/procedure/knee_exam_watch.h"
#include "osteon/procedure/tunnel_events.h"

namespace osteon {
namespace {

struct ExamRuleRig {
  explicit ExamRuleRig(const std::string& kind, double grafted = 0) {
    EXPECT_NE(find_rule_kind(kind), nullptr) << kind;
    rule.rule.kind = kind;
    rule.rule.numbers = {{"grafted", grafted}};
    state.holds.resize(1);
  }
  bool hit(EventKind kind, double test = 0, double grafted = 0) {
    Event event;
    event.kind = kind;
    event.values = {test, grafted, 9};
    std::optional<RuleHit> made;
    EXPECT_TRUE(step_exam_rule(rule, event, 0.001, state, made));
    return made.has_value();
  }
  PlannedRule rule;
  RuleState state;
};

TEST(ExamRules, LeaveOtherRulesAlone) {
  PlannedRule rule;
  rule.rule.kind = "felt";
  RuleState state;
  std::optional<RuleHit> made;
  EXPECT_FALSE(step_exam_rule(rule, {}, 0.001, state, made));
}

TEST(ExamRules, AKneeIsExaminedByBothTestsOfIt) {
  for (const double first : {0.0, 1.0}) {
    ExamRuleRig rig("knee_examined");
    rig.hit(kKneeExamined, first);
    rig.hit(kKneeExamined, first);
    EXPECT_FALSE(rig.state.met);
    rig.hit(kKneeExamined, 1 - first, 1);  // of the knee with its graft
    EXPECT_FALSE(rig.state.met);
    rig.hit(kKneeExamined, 1 - first);
    EXPECT_TRUE(rig.state.met);
  }
  ExamRuleRig grafted("knee_examined", 1);
  for (const double test : {0.0, 1.0}) grafted.hit(kKneeExamined, test);
  EXPECT_FALSE(grafted.state.met);
  for (const double test : {0.0, 1.0}) grafted.hit(kKneeExamined, test, 1);
  EXPECT_TRUE(grafted.state.met);
}

TEST(ExamRules, AKneeIsBentWhereItStandsNearEnough) {
  ExamRuleRig rig("knee_bent");
  rig.rule.rule.numbers = {{"to_deg", 120}, {"within_deg", 3}};
  rig.hit(kKneeExamined, 120);
  for (const double deg : {80.0, 116.9, 123.1}) rig.hit(kKneeBent, deg);
  EXPECT_FALSE(rig.state.met);
  EXPECT_FALSE(rig.hit(kKneeBent, 117.1));
  EXPECT_TRUE(rig.state.met);
}

TEST(ExamRules, ATunnelBeforeBothTestsIsOneError) {
  ExamRuleRig rig("unexamined");
  EXPECT_FALSE(rig.hit(kKneeExamined, 0));
  EXPECT_TRUE(rig.hit(kTunnelBegun));
  EXPECT_FALSE(rig.hit(kTunnelBegun));
  ExamRuleRig good("unexamined");
  good.hit(kKneeExamined, 1);
  good.hit(kKneeExamined, 0);
  EXPECT_FALSE(good.hit(kTunnelBegun));
}

}  // namespace
}  // namespace osteon
