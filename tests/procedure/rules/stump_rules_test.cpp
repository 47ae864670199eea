#include "rules/stump_rules.h"

#include <gtest/gtest.h>

#include "osteon/procedure/stump_watch.h"
#include "osteon/procedure/tunnel_events.h"

namespace osteon {
namespace {

struct StumpRuleRig {
  explicit StumpRuleRig(const std::string& kind) {
    const RuleKind* row = find_rule_kind(kind);
    EXPECT_NE(row, nullptr) << kind;
    rule.rule.kind = kind;
    rule.about = row->about;
    rule.heeds = row->heeds;
    rule.heeds_too = row->heeds_too;
    rule.rule.numbers["share"] = 0.9;
    state.holds.resize(1);
  }
  // As the judge does.
  bool hit(EventKind kind, double percent = 0) {
    Event event;
    event.kind = kind;
    event.hand = 0;
    event.subject_kind = kind == kTunnelBegun ? SubjectKind::kLandmark : SubjectKind::kNothing;
    event.values = {percent, 0, 0};
    return step_rule(rule, event, 0.001, state).has_value();
  }
  PlannedRule rule;
  RuleState state;
};

TEST(StumpRules, TheGoalIsMetAtItsShareAndNoMoreOnceItIsUndone) {
  StumpRuleRig rig("stumps_cleared");
  rig.hit(kStumpsCleared, 89);
  EXPECT_FALSE(rig.state.met);
  rig.hit(kStumpsCleared, 90);
  EXPECT_TRUE(rig.state.met);
  rig.hit(kStumpsCleared, 12);
  EXPECT_FALSE(rig.state.met);
}

TEST(StumpRules, DrillingIsAnErrorWhileTooMuchIsLeftAndTheErrorIsMadeOnce) {
  StumpRuleRig rig("stump_left");
  EXPECT_FALSE(rig.hit(kStumpsCleared, 50));
  EXPECT_TRUE(rig.hit(kTunnelBegun));
  EXPECT_FALSE(rig.hit(kTunnelBegun));
  StumpRuleRig clean("stump_left");
  EXPECT_FALSE(clean.hit(kStumpsCleared, 95));
  EXPECT_FALSE(clean.hit(kTunnelBegun));
  StumpRuleRig untouched("stump_left");
  EXPECT_TRUE(untouched.hit(kTunnelBegun));
}

TEST(StumpWatch, TellsWholePercentsOnceAndWhatARestorePointBringsBack) {
  StumpWatch watch;
  std::vector<Event> out;
  BoneSnapshot bones;
  watch.add(1, bones, out);  // there are no stumps
  EXPECT_TRUE(out.empty());
  for (const double percent : {0.0, 0.5, 1.2, 1.9, 40.0, 0.0}) {
    bones.cleared_percent = percent;
    watch.add(2, bones, out);
  }
  std::vector<double> told;
  for (const Event& event : out) told.push_back(event.values[0]);
  EXPECT_EQ(told, (std::vector<double>{1, 40, 0}));
  // Again from time to time, where there is something to tell.
  out.clear();
  watch.add(kTellStumps, bones, out);
  EXPECT_TRUE(out.empty());
  bones.cleared_percent = 95;
  watch.add(kTellStumps + 1, bones, out);
  watch.add(kTellStumps + 2, bones, out);
  watch.add(2 * kTellStumps, bones, out);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[1].values[0], 95);
}

}  // namespace
}  // namespace osteon
