// Rules about what a hand does with some instruments alone.
#include "rules/rule_instruments.h"

#include <gtest/gtest.h>

#include "../report_fixtures.h"
#include "osteon/procedure/attempt.h"
#include "osteon/procedure/judge.h"

namespace osteon {
namespace {

const char* const kHookText = R"(format = 1
name = "two"
title = "Two bones"
text = "Touch them."
version = 1
anatomy = "wrist"

[[hands]]
name = "right"
instrument = "hook_probe"
also = ["trocar_blunt", "graft_sizer:8"]

[[hands]]
name = "left"
instrument = "shaver"

[[stages]]
name = "first"
title = "A"
instruction = "Touch radius and lunate."
[[stages.goals]]
rule = "touched"
bones = ["radius", "lunate"]
hand = "right"
)";

Scenario with(const std::string& instruments) {
  auto scenario = parse_scenario(kHookText + ("instruments = " + instruments + "\n"), "two.toml");
  EXPECT_TRUE(scenario) << scenario.error().message();
  return std::move(*scenario);
}

const Case& two_bones() {
  static const Case the_case = testing::named_case({"radius", "lunate"});
  return the_case;
}

// Whether both bones count as touched by the right hand.
bool is_met(const std::string& instruments, const std::vector<std::string_view>& held) {
  const auto plan = plan_scenario(with(instruments), two_bones());
  EXPECT_TRUE(plan) << plan.error().message();
  if (!plan) return false;
  ScenarioState state = begin_scenario(*plan);
  for (const std::uint32_t bone : {0u, 1u}) {
    Event event;
    event.tick = 1000u * (bone + 1);
    event.kind = EventKind::kContactEnd;
    event.hand = 0;
    event.subject_kind = SubjectKind::kBone;
    event.subject = bone;
    event.values = {0.3, 1, 0.1};
    judge(*plan, event, 0.001, state, held);
  }
  return state.over;
}

TEST(RuleInstruments, WithoutAnyWhateverIsHeldWillDo) {
  EXPECT_TRUE(is_met("[]", {}));
  EXPECT_TRUE(is_met("[]", {"trocar_blunt", "shaver"}));
}

TEST(RuleInstruments, OneOfThoseThatAreNamedMustBeHeld) {
  const std::string hook_or_sizer = "[\"hook_probe\", \"graft_sizer\"]";
  EXPECT_FALSE(is_met(hook_or_sizer, {})) << "nobody knows what is held";
  EXPECT_FALSE(is_met(hook_or_sizer, {""}));
  EXPECT_FALSE(is_met(hook_or_sizer, {"trocar_blunt", "hook_probe"})) << "in the other hand";
  EXPECT_TRUE(is_met(hook_or_sizer, {"hook_probe", "shaver"}));
  EXPECT_TRUE(is_met(hook_or_sizer, {"graft_sizer:8"})) << "of whatever size";
}

TEST(RuleInstruments, WhatNoHandThatIsMeantMayTakeIsAnError) {
  for (const char* name : {"hammer", "shaver", "graft_sizer:8"}) {
    const Scenario scenario = with(std::string("[\"") + name + "\"]");
    const auto plan = plan_scenario(scenario, two_bones());
    ASSERT_FALSE(plan) << name;
    EXPECT_NE(plan.error().message().find(name), std::string::npos);
    const auto lines = check_scenario(scenario, two_bones());
    ASSERT_EQ(lines.size(), 1u) << name;
    EXPECT_NE(lines[0].find("no hand may take '" + std::string(name)), std::string::npos);
    EXPECT_NE(lines[0].find("two.toml:"), std::string::npos);
  }
  EXPECT_TRUE(check_scenario(with("[\"graft_sizer\"]"), two_bones()).empty());
}

}  // namespace
}  // namespace osteon
