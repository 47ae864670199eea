#include "rules/stump_rules.h"

#include <gtest/gtest.h>

#include "osteon/procedure/sound_part_watch.h"
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
  bool hit(EventKind kind, double percent = 0, double blind_percent = 0, double before = 0) {
    Event event;
    event.kind = kind;
    event.hand = 0;
    event.subject_kind = kind == kTunnelBegun ? SubjectKind::kLandmark : SubjectKind::kNothing;
    event.values = {percent, blind_percent, before};
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

TEST(StumpRules, ClearingWithoutALookIsAnErrorBeyondItsShareAndIsMadeOnce) {
  StumpRuleRig rig("stumps_unseen");
  rig.rule.rule.numbers["share"] = 0.1;
  EXPECT_FALSE(rig.hit(kStumpsCleared, 50, 10));
  EXPECT_FALSE(rig.hit(kTunnelBegun));
  EXPECT_TRUE(rig.hit(kStumpsCleared, 60, 10.5));
  EXPECT_FALSE(rig.hit(kStumpsCleared, 70, 20));
}

TEST(StumpRules, EachVisitInASoundPartThatIsLongAndDeepEnoughIsOneError) {
  StumpRuleRig rig("sound_part_cut");
  rig.rule.rule.numbers = {{"for_s", 0.3}, {"deep_mm", 1}};
  EXPECT_FALSE(rig.hit(kSoundPartCleared, 0.25, 4)) << "short";
  EXPECT_FALSE(rig.hit(kSoundPartCleared, 0.35, 0.8)) << "shallow";
  EXPECT_TRUE(rig.hit(kSoundPartCleared, 0.4, 1.2));
  EXPECT_FALSE(rig.hit(kSoundPartCleared, 0.45, 2)) << "the same visit";
  EXPECT_FALSE(rig.hit(kSoundPartCleared, 0.05, 3));
  EXPECT_TRUE(rig.hit(kSoundPartCleared, 0.3, 3)) << "another";
  EXPECT_FALSE(rig.hit(kStumpsCleared, 60, 50));
}

TEST(StumpRules, ASoundPartThatIsFeltMayLoseALittleAndAnErrorIsMadeAsItLosesMore) {
  StumpRuleRig rig("sound_part_cut");
  rig.rule.rule.numbers = {{"for_s", 0.3}, {"deep_mm", 1}, {"lost_mm3", 10}, {"lost_percent", 5}};
  EXPECT_FALSE(rig.hit(kSoundPartLost, 9.9, 0, 8)) << "of a meniscus";
  EXPECT_TRUE(rig.hit(kSoundPartLost, 12.3, 0, 9));
  EXPECT_FALSE(rig.hit(kSoundPartLost, 30, 0, 12)) << "told";
  EXPECT_FALSE(rig.hit(kSoundPartLost, 0, 4.9, 3)) << "of a ligament";
  EXPECT_TRUE(rig.hit(kSoundPartLost, 0, 6.6, 4));
  EXPECT_FALSE(rig.hit(kSoundPartLost, 0, 8.2, 6));
  EXPECT_TRUE(rig.hit(kSoundPartLost, 0, 5, 0)) << "after a restore point";
}

}  // namespace
}  // namespace osteon
