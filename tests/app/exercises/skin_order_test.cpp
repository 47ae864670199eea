#include "exercises/skin_order.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

ScenarioPlan plan_of(std::initializer_list<const char*> kinds) {
  ScenarioPlan plan;
  for (const char* kind : kinds) {
    plan.scenario.stages.emplace_back();
    plan.scenario.stages.back().name = kind;
    plan.scenario.stages.back().goals.emplace_back();
    plan.scenario.stages.back().goals.back().kind = kind;
  }
  return plan;
}

TEST(SkinOrder, SaysNothingWhereTheKneeIsNotBentAfterPortals) {
  for (const ScenarioPlan& plan :
       {plan_of({}), plan_of({"portal_made", "seen"}), plan_of({"knee_bent", "seen"}),
        plan_of({"knee_bent", "portal_made"})}) {
    SkinOrder order;
    ScenarioState state;
    state.stage = 9;
    order.see(plan, state, 0);
    EXPECT_FALSE(order.take());
  }
}

TEST(SkinOrder, SaysItOnceWhenThatStageBegins) {
  const ScenarioPlan plan = plan_of({"portal_made", "through", "portal_made", "knee_bent", "seen"});
  EXPECT_EQ(stage_bent_after_portals(plan), 3u);
  SkinOrder order;
  ScenarioState state;
  for (state.stage = 0; state.stage < 3; ++state.stage) {
    order.see(plan, state, 0);
    EXPECT_FALSE(order.take());
  }
  order.see(plan, state, 0);
  const auto said = order.take();
  ASSERT_TRUE(said);
  EXPECT_EQ(said->kind, CommandKind::kBareSkin);
  order.see(plan, state, 0);
  EXPECT_FALSE(order.take());
}

// Back where skin was still felt it is told once more, at the same stage as before.
TEST(SkinOrder, SaysItAgainAfterARestorePoint) {
  const ScenarioPlan plan = plan_of({"portal_made", "knee_bent"});
  SkinOrder order;
  ScenarioState state;
  state.stage = 1;
  order.see(plan, state, 4);
  ASSERT_TRUE(order.take());
  state.stage = 0;
  order.see(plan, state, 5);
  EXPECT_FALSE(order.take());
  state.stage = 1;
  order.see(plan, state, 5);
  EXPECT_TRUE(order.take());
  order.see(plan, state, 5);
  EXPECT_FALSE(order.take());
}

TEST(SkinOrder, SkinThatIsOpenedLaterIsFeltUntilThatStageIsOver) {
  const ScenarioPlan plan =
      plan_of({"portal_made", "knee_bent", "skin_opened", "tendons_stripped"});
  EXPECT_EQ(stage_after_incision(plan), 3u);
  EXPECT_FALSE(stage_after_incision(plan_of({"portal_made", "knee_bent"})));
  SkinOrder order;
  ScenarioState state;
  state.stage = 1;
  order.see(plan, state, 0);
  EXPECT_EQ(order.take()->value, 0);
  state.stage = 2;
  order.see(plan, state, 0);
  EXPECT_FALSE(order.take());
  state.stage = 3;
  order.see(plan, state, 0);
  const auto all = order.take();
  ASSERT_TRUE(all);
  EXPECT_EQ(all->kind, CommandKind::kBareSkin);
  EXPECT_EQ(all->value, 1);
  order.see(plan, state, 0);
  EXPECT_FALSE(order.take());
  // Back before the incision, and on again.
  state.stage = 2;
  order.see(plan, state, 1);
  EXPECT_EQ(order.take()->value, 0);
  state.stage = 3;
  order.see(plan, state, 1);
  EXPECT_EQ(order.take()->value, 1);
}

TEST(SkinOrder, SkinIsForPortalsByItsName) {
  for (const char* name : {"skin", "skin:portal_al", "skin:portal_3_4"}) {
    EXPECT_TRUE(is_skin_of_portals(name)) << name;
    EXPECT_FALSE(is_skin_elsewhere(name)) << name;
  }
  EXPECT_TRUE(is_skin_elsewhere("skin:pes_anserinus"));
  for (const char* name : {"skin:pes_anserinus", "menisci", "stumps"})
    EXPECT_FALSE(is_skin_of_portals(name)) << name;
  EXPECT_FALSE(is_skin_elsewhere("menisci"));
}

TEST(SkinOrder, StagesOfPortalsThatWereMadeBeforeAreLeftOut) {
  Scenario scenario =
      plan_of({"portal_made", "through", "portal_made", "knee_bent", "seen", "knee_bent"}).scenario;
  scenario.soft = {"stumps", "skin:portal_al", "skin:portal_am", "skin:pes_anserinus"};
  leave_out_puncture_stages(scenario);
  ASSERT_EQ(scenario.stages.size(), 2u);
  EXPECT_EQ(scenario.stages[0].name, "seen");
  EXPECT_EQ(scenario.stages[1].name, "knee_bent");
  EXPECT_EQ(scenario.soft, (std::vector<std::string>{"stumps", "skin:pes_anserinus"}));
  leave_out_puncture_stages(scenario);
  EXPECT_EQ(scenario.stages.size(), 2u);
  Scenario looks = plan_of({"portal_made", "seen", "knee_bent", "felt"}).scenario;
  leave_out_puncture_stages(looks);
  ASSERT_EQ(looks.stages.size(), 1u) << "what is looked at before the knee is bent goes with them";
  EXPECT_EQ(looks.stages[0].name, "felt");
}

}  // namespace
}  // namespace osteon
