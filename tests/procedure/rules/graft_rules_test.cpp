#include <gtest/gtest.h>

#include "osteon/procedure/graft_watch.h"
#include "rules/graft_rules.h"

namespace osteon {
namespace {

struct GraftRuleRig {
  GraftRuleRig(const std::string& kind, std::map<std::string, double> numbers = {}) {
    const RuleKind* row = find_rule_kind(kind);
    EXPECT_NE(row, nullptr) << kind;
    rule.rule.kind = kind;
    for (const auto& number : row->numbers)
      rule.rule.numbers[std::string(number.name)] = number.usual;
    for (const auto& [name, value] : numbers) rule.rule.numbers[name] = value;
    state.holds.resize(1);
  }
  bool hit(EventKind kind, std::array<double, 3> values) {
    Event event;
    event.kind = kind;
    event.values = values;
    std::optional<RuleHit> made;
    EXPECT_TRUE(step_graft_rule(rule, event, 0.001, state, made));
    return made.has_value();
  }
  PlannedRule rule;
  RuleState state;
};

TEST(GraftRules, ATendonThatIsCutOffIsAnErrorAndAWholeOneIsNot) {
  GraftRuleRig rig("tendon_amputated");
  EXPECT_FALSE(rig.hit(kTendonStripped, {280, 0, 1}));
  EXPECT_TRUE(rig.hit(kTendonStripped, {85, 1, 1}));
  EXPECT_FALSE(rig.hit(kTendonFolded, {4, 1, 1}));
}

TEST(GraftRules, BothTendonsAreCounted) {
  GraftRuleRig rig("tendons_stripped");
  rig.hit(kTendonStripped, {280, 0, 1});
  EXPECT_FALSE(rig.state.met);
  rig.hit(kTendonStripped, {260, 0, 2});
  EXPECT_TRUE(rig.state.met);
}

TEST(GraftRules, FasciaAndTendonsUnderIt) {
  GraftRuleRig open("fascia_opened"), found("tendons_found"), ligament("mcl_cut"),
      nerve("nerve_cut");
  open.hit(kFasciaOpened, {29, 0, 0});
  EXPECT_FALSE(open.state.met);
  open.hit(kFasciaOpened, {30, 0, 0});
  EXPECT_TRUE(open.state.met);
  found.hit(kTendonFound, {1, 0, 0});
  EXPECT_FALSE(found.state.met);
  found.hit(kTendonFound, {2, 0, 0});
  EXPECT_TRUE(found.state.met);
  EXPECT_FALSE(ligament.hit(kByFasciaHurt, {1, 0, 0}));
  EXPECT_TRUE(ligament.hit(kByFasciaHurt, {0, 0, 0}));
  EXPECT_FALSE(nerve.hit(kByFasciaHurt, {0, 0, 0}));
  EXPECT_TRUE(nerve.hit(kByFasciaHurt, {1, 0, 0}));
}

TEST(GraftRules, MuscleAndThreadOfBothTendons) {
  GraftRuleRig muscle("muscle_off");
  muscle.hit(kMuscleScraped, {50, 0, 0});
  EXPECT_FALSE(muscle.state.met);
  muscle.hit(kMuscleScraped, {10, 0, 0});
  EXPECT_TRUE(muscle.state.met);
  GraftRuleRig thread("tendons_stitched");
  thread.hit(kTendonStitched, {4, 0, 0});
  EXPECT_FALSE(thread.state.met);
  thread.hit(kTendonStitched, {5, 0, 0});
  EXPECT_TRUE(thread.state.met);
}

TEST(GraftRules, AGraftIsSizedOnceTheNextSmallerCylinderIsRefused) {
  GraftRuleRig rig("graft_sized");
  rig.hit(kGraftSized, {8.5, 0, 125});
  EXPECT_FALSE(rig.state.met);
  rig.hit(kGraftSized, {8.5, 7.5, 125});
  EXPECT_FALSE(rig.state.met);
  rig.hit(kGraftSized, {7.5, 7, 125});  // too thin
  EXPECT_FALSE(rig.state.met);
  rig.hit(kGraftSized, {8.5, 8, 60});  // too short
  EXPECT_FALSE(rig.state.met);
  rig.hit(kGraftSized, {8.5, 8, 125});
  EXPECT_TRUE(rig.state.met);
}

TEST(GraftRules, FoldingTensionAndLoop) {
  GraftRuleRig folded("graft_folded"), tensioned("graft_tensioned"), hung("loop_hung"),
      stuck("button_stuck");
  folded.hit(kTendonFolded, {2, 0, 0});
  EXPECT_FALSE(folded.state.met);
  folded.hit(kTendonFolded, {4, 0, 0});
  EXPECT_TRUE(folded.state.met);
  tensioned.hit(kGraftTensioned, {50, 80, 0});
  EXPECT_FALSE(tensioned.state.met);
  tensioned.hit(kGraftTensioned, {60, 80, 0});
  EXPECT_TRUE(tensioned.state.met);
  EXPECT_FALSE(stuck.hit(kLoopHung, {20, 20, 1}));
  EXPECT_TRUE(stuck.hit(kLoopHung, {15, 25, 0}));
  hung.hit(kLoopHung, {20, 20, 1});
  EXPECT_TRUE(hung.state.met);
}

TEST(GraftRules, AValueOutsideItsRangeIsAnError) {
  GraftRuleRig rig("outside_graft_in_socket_mm", {{"least", 14}});
  const auto which = static_cast<double>(GraftValue::kInSocket);
  EXPECT_FALSE(rig.hit(kGraftMeasured, {which, 15, 0}));
  EXPECT_TRUE(rig.hit(kGraftMeasured, {which, 13, 0}));
  EXPECT_FALSE(rig.hit(kGraftMeasured, {which - 1, 4, 0}));
}

}  // namespace
}  // namespace osteon
