#include "exercises/graft_order.h"

#include <gtest/gtest.h>

#include "../../placing_case.h"

namespace osteon {
namespace {

PlacingPlan ordered_plan() { return *find_placing(*testing::placing_knee()); }

std::vector<Command> all_of(GraftOrder& order) {
  std::vector<Command> said;
  while (const auto next = order.take()) said.push_back(*next);
  return said;
}

TEST(GraftOrder, StagesAtTheBenchAreLeftOutWhereTheGraftIsMade) {
  Scenario scenario;
  for (const char* kind : {"seen", "skin_opened", "tendons_found", "tendons_stripped",
                           "graft_sized", "socket_drilled", "loop_hung", "thread_laid"}) {
    scenario.stages.emplace_back();
    scenario.stages.back().name = kind;
    scenario.stages.back().goals.emplace_back();
    scenario.stages.back().goals.back().kind = kind;
  }
  scenario.soft = {"menisci", "skin:portal_al", "skin:pes_anserinus"};
  leave_out_bench_stages(scenario);
  EXPECT_EQ(scenario.soft, (std::vector<std::string>{"menisci", "skin:portal_al"}));
  ASSERT_EQ(scenario.stages.size(), 3u);
  EXPECT_EQ(scenario.stages[0].name, "seen");
  EXPECT_EQ(scenario.stages[1].name, "socket_drilled");
  EXPECT_EQ(scenario.stages[2].name, "thread_laid");
}

TEST(GraftOrder, AStageIsWorkedOnWhereItsGoalsAre) {
  const auto place = [](const std::string& kind) {
    ScenarioStage stage;
    stage.goals.emplace_back();
    stage.goals.back().kind = "seen";
    stage.goals.emplace_back();
    stage.goals.back().kind = kind;
    return place_of_work(stage);
  };
  EXPECT_EQ(place_of_work(ScenarioStage{}), WorkPlace::kJoint);
  EXPECT_EQ(place("socket_drilled"), WorkPlace::kJoint);
  EXPECT_EQ(place("portal_made"), WorkPlace::kJoint);
  EXPECT_EQ(place("skin_opened"), WorkPlace::kSkin);
  EXPECT_EQ(place("fascia_opened"), WorkPlace::kFascia);
  EXPECT_EQ(place("tendons_found"), WorkPlace::kFascia);
  EXPECT_EQ(place("tendons_stripped"), WorkPlace::kBench);
  EXPECT_EQ(place("loop_hung"), WorkPlace::kBench);
}

TEST(GraftOrder, SaysNothingUntilTheTunnelsAreMeasured) {
  GraftOrder order;
  order.see(std::nullopt, BoneSnapshot{});
  EXPECT_FALSE(order.take());
}

TEST(GraftOrder, TellsEveryNumberOnceAndAgainWhereItDoesNotCome) {
  GraftOrder order;
  BoneSnapshot bones;
  const PlacingPlan plan = ordered_plan();
  order.see(plan, bones);
  const auto said = all_of(order);
  ASSERT_EQ(said.size(), 1 + kPlacingNumbers);
  EXPECT_EQ(said[0].kind, CommandKind::kGraftOrder);
  const PlacingNumbers numbers = placing_numbers(plan);
  for (std::size_t i = 0; i < kPlacingNumbers; ++i) {
    EXPECT_EQ(said[i + 1].kind, CommandKind::kGraftNumber);
    EXPECT_EQ(said[i + 1].value, numbers[i]);
  }
  bones.time_s = 0.5;  // it may be under way
  order.see(plan, bones);
  EXPECT_TRUE(all_of(order).empty());
  bones.time_s = 1.5;
  order.see(plan, bones);
  EXPECT_EQ(all_of(order).size(), 1 + kPlacingNumbers);
}

// One number a picture, ten pictures a second, each of the state one picture before.
TEST(GraftOrder, ASlowPictureDoesNotMakeItTellTheGraftAnew) {
  GraftOrder order;
  BoneSnapshot bones;
  const PlacingPlan plan = ordered_plan();
  std::size_t told = 0, orders = 0;
  for (int picture = 0; picture < 100; ++picture) {
    bones.time_s = 0.1 * picture;
    bones.placing.on = told == kPlacingNumbers;
    bones.placing.plan = plan;
    order.see(plan, bones);
    const auto said = order.take();
    if (!said) continue;
    const bool begins = said->kind == CommandKind::kGraftOrder;
    orders += begins ? 1 : 0;
    told = begins ? 0 : told + 1;
  }
  EXPECT_EQ(orders, 1u);
  EXPECT_EQ(told, kPlacingNumbers);
}

TEST(GraftOrder, AGraftThatIsThereIsReplacedOnlyBeforeItIsUsed) {
  BoneSnapshot bones;
  const PlacingPlan plan = ordered_plan();
  bones.placing.on = true;
  bones.placing.plan = plan;
  GraftOrder same;
  same.see(plan, bones);
  EXPECT_TRUE(all_of(same).empty());
  PlacingPlan deeper = plan;
  deeper.socket_m += 0.001;
  GraftOrder other;
  other.see(deeper, bones);
  EXPECT_FALSE(all_of(other).empty());
  bones.placing.phase = PlacingPhase::kThreadInside;
  GraftOrder late;
  late.see(deeper, bones);
  EXPECT_TRUE(all_of(late).empty());
}

}  // namespace
}  // namespace osteon
