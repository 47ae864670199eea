#include "osteon/physics/graft_bench_work.h"

#include <gtest/gtest.h>

#include <utility>

#include "graft_bench_case.h"

#include "osteon/base/turn.h"

namespace osteon {
namespace {

using testing::bench_case;
using testing::folded_bench;

enum BenchTray : std::uint32_t {
  kBladeTool,
  kStripperTool,
  kSizer8,
  kSizer75,
  kButton20,
  kClampTool,
  kNeedleTool
};

std::vector<BenchTool> bench_tray() {
  using Kind = BenchTool::Kind;
  return {{Kind::kBlade, 0.024},  {Kind::kStripper, 0.006}, {Kind::kSizer, 0.008},
          {Kind::kSizer, 0.0075}, {Kind::kButton, 0.020},   {Kind::kClamp, 0.140},
          {Kind::kNeedle, 0.150}};
}

// A hand at a bench of which the haptic half is played: a tool that is pushed stands at its front,
// with the force asked for.
struct BenchRig {
  explicit BenchRig(CaseDef def = testing::bench_def())
      : work(*find_graft_bench(*bench_case(std::move(def))), bench_tray(), 0.002) {
    bones.count = 3;
    for (std::size_t i = 0; i < 3; ++i) bones.bones[i].X_WB = bench_case()->bones[i].X_WB;
    state = fresh_bench(work.plan());
  }
  void step() {
    const ToolState* const tools[] = {&tool};
    work.step(tools, bones, state);
  }
  void hold(std::uint32_t instrument) {
    tool = ToolState{};
    tool.instrument = instrument;
    step();
  }
  void at(const Vec3& p_W) {
    tool.X_WP = {p_W, turn_between(Vec3::UnitZ(), Vec3(-Vec3::UnitX()))};
    tool.X_WD = tool.X_WP;
    step();
  }
  // Along a line, at its front, for a while.
  void push(std::uint32_t line, double force_n, double seconds) {
    const Vec3 from = work.plan().begin_W(line);
    if (state.hands[0].line != line + 1) at(from);
    for (int n = 0; n < static_cast<int>(seconds / 0.002); ++n) {
      const double front = line <= 1 ? state.tendons[line].front_m : state.hands[0].front_m;
      tool.force_W = Vec3(-force_n, 0, 0);
      at(from + Vec3(front, 0, 0));
    }
    tool.force_W = Vec3::Zero();
  }
  GraftBenchWork work;
  BoneSnapshot bones;
  GraftBenchState state;
  ToolState tool;
};

TEST(GraftBenchWork, AStripperGoesOnAboveTheResistanceOnly) {
  BenchRig rig;
  rig.state.tendons[0].bands_cut = 0b11;
  rig.hold(kStripperTool);
  rig.push(0, 1.0, 1);
  EXPECT_EQ(rig.state.tendons[0].front_m, 0);
  ASSERT_TRUE(rig.work.guides()[0].on);
  EXPECT_EQ(rig.work.guides()[0].stop_m, 0);
  rig.push(0, 2.0, 0.5);
  EXPECT_GT(rig.state.tendons[0].front_m, 0.01);
  EXPECT_EQ(rig.work.guides()[0].stop_m, -rig.state.tendons[0].front_m);
  rig.push(0, 3.5, 8);
  EXPECT_TRUE(rig.state.tendons[0].stripped);
  EXPECT_FALSE(rig.state.tendons[0].amputated);
  EXPECT_NEAR(rig.state.tendons[0].front_m, 0.280, 1e-12);
}

TEST(GraftBenchWork, ABandStopsTheStripperAndGivesWayWithTheTendon) {
  BenchRig rig;
  rig.state.tendons[0].bands_cut = 0b01;  // the second one is whole
  rig.hold(kStripperTool);
  rig.push(0, 3.5, 10);
  EXPECT_FALSE(rig.state.tendons[0].stripped);
  EXPECT_NEAR(rig.state.tendons[0].front_m, 0.0835, 0.0015);
  rig.push(0, 6.5, 1);
  EXPECT_TRUE(rig.state.tendons[0].amputated);
  EXPECT_NEAR(harvested(rig.work.plan(), rig.state, 0)->length_m, 0.085, 1e-12);
  // Cut in time it comes out whole.
  BenchRig other;
  other.hold(kBladeTool);
  other.tool.contact_count = 1;
  other.tool.force_W = Vec3(0, 0, 0.5);
  for (const double x : {0.060, 0.085})
    for (int n = -10; n <= 10; ++n) other.at(Vec3(x, 0.012 + 0.0005 * n, 0));
  EXPECT_EQ(other.state.tendons[0].bands_cut, 0b11u);
  EXPECT_EQ(other.state.tendons[1].bands_cut, 0u);
  other.hold(kStripperTool);
  other.push(0, 3.5, 10);
  EXPECT_TRUE(other.state.tendons[0].stripped);
  EXPECT_FALSE(other.state.tendons[0].amputated);
}

TEST(GraftBenchWork, ABladeThatIsNotPressedOrNotDrawnCutsNothing) {
  BenchRig rig;
  rig.hold(kBladeTool);
  for (int n = -10; n <= 10; ++n) rig.at(Vec3(0.060, 0.012 + 0.0005 * n, 0));
  rig.tool.contact_count = 1;
  rig.tool.force_W = Vec3(0, 0, 0.5);
  for (int n = 0; n < 200; ++n) rig.at(Vec3(0.060, 0.012, 0));
  EXPECT_EQ(rig.state.tendons[0].bands_cut, 0u);
}

// Fascia opened, tendon lifted out, bands cut, stripped: nothing of it before what comes first.
TEST(GraftBenchWork, ACoveredTendonIsFoundBeforeItsBandsAreCutAndItIsStripped) {
  BenchRig rig(testing::covered_bench_def());
  const auto cut_bands = [&] {
    rig.hold(kBladeTool);
    rig.tool.contact_count = 1;
    rig.tool.force_W = Vec3(0, 0, 0.5);
    for (const double x : {0.060, 0.085})
      for (int n = -10; n <= 10; ++n) rig.at(Vec3(x, 0.012 + 0.0005 * n, 0));
  };
  cut_bands();
  EXPECT_EQ(rig.state.tendons[0].bands_cut, 0u);
  rig.hold(kStripperTool);
  rig.at(rig.work.plan().begin_W(0));
  EXPECT_EQ(rig.state.hands[0].line, 0u);
  rig.hold(kBladeTool);
  rig.tool.contact_count = 1;
  rig.tool.force_W = Vec3(0, 0, 0.5);
  for (int n = 0; n <= 70; ++n) rig.at(Vec3(0.007 + 0.0005 * n, 0, 0));
  EXPECT_GT(fascia_open_m(rig.work.plan(), rig.state), 0.03);
  rig.hold(kClampTool);
  rig.tool.jaw = 1;
  rig.at(found_at_W(rig.work.plan(), 0));
  rig.tool.jaw = 0;
  rig.at(found_at_W(rig.work.plan(), 0));
  ASSERT_TRUE(rig.work.guides()[0].on && rig.work.guides()[0].pulls);
  EXPECT_EQ(rig.work.guides()[0].instrument, kClampTool);
  rig.tool.force_W = Vec3(0, 0, -2);
  for (int n = 0; n < 1000; ++n) rig.step();
  EXPECT_TRUE(rig.state.tendons[0].found);
  rig.tool.jaw = 1;
  rig.step();
  EXPECT_FALSE(rig.work.guides()[0].on);
  cut_bands();
  EXPECT_EQ(rig.state.tendons[0].bands_cut, 0b11u);
  rig.hold(kStripperTool);
  rig.push(0, 3.5, 10);
  EXPECT_TRUE(rig.state.tendons[0].stripped);
}

TEST(GraftBenchWork, AClampFoldsATendonAtAPost) {
  BenchRig rig;
  rig.state.tendons[0].stripped = true;
  rig.hold(kClampTool);
  const auto grasp_and_leave = [&](std::size_t tendon, std::size_t post) {
    rig.tool.jaw = 1;
    rig.at(rig.work.plan().tendons[tendon].free_W);
    rig.tool.jaw = 0;
    rig.at(rig.work.plan().tendons[tendon].free_W);
    rig.at(rig.work.plan().posts_W[post]);
    rig.tool.jaw = 1;
    rig.at(rig.work.plan().posts_W[post]);
  };
  grasp_and_leave(0, 1);
  EXPECT_EQ(rig.state.tendons[0].folds, 3u);
  grasp_and_leave(1, 0);  // still in the patient
  EXPECT_EQ(rig.state.tendons[1].folds, 0u);
  grasp_and_leave(0, 0);
  EXPECT_EQ(rig.state.tendons[0].folds, 2u);
}

// 7.9 mm thick.
TEST(GraftBenchWork, OnlyASizerThatIsWideEnoughPasses) {
  BenchRig rig;
  rig.state = folded_bench(2, 2);
  rig.hold(kSizer75);
  rig.push(GraftBenchPlan::kGraft, 5, 3);
  EXPECT_EQ(rig.state.passed_m, 0);
  EXPECT_NEAR(rig.state.refused_m, 0.0075, 1e-12);
  rig.hold(kSizer8);
  rig.push(GraftBenchPlan::kGraft, 4, 3);
  EXPECT_NEAR(rig.state.passed_m, 0.008, 1e-12);
  EXPECT_NEAR(rig.state.refused_m, 0.0075, 1e-12);
}

TEST(GraftBenchWork, TheBoardKeepsWhatItWasPulledTo) {
  BenchRig rig;
  rig.state = folded_bench(2, 2);
  rig.hold(kClampTool);
  rig.push(GraftBenchPlan::kBoard, 80 / GraftBenchWork::kLever, 5);
  EXPECT_NEAR(rig.state.tension_n, 80, 2);
  EXPECT_TRUE(rig.work.guides()[0].on);
  rig.at(rig.work.plan().board_from_W - Vec3(0.01, 0, 0));  // drawn back
  const double before = rig.state.creep_s;
  rig.tool = ToolState{};
  rig.tool.instrument = kClampTool;
  for (int n = 0; n < 500; ++n) rig.at(Vec3(0, 0, 0.2));
  EXPECT_NEAR(rig.state.creep_s - before, rig.state.tension_n / 80 * GraftBenchWork::kClock, 0.1);
  EXPECT_FALSE(rig.work.guides()[0].on);
}

TEST(GraftBenchWork, ALoopIsHungOnWhatIsFolded) {
  BenchRig rig;
  rig.hold(kButton20);
  for (int n = 0; n < 400; ++n) rig.at(rig.work.plan().hook_W);
  EXPECT_EQ(rig.state.loop_m, 0);
  rig.state = folded_bench(2, 2);
  rig.hold(kButton20);
  for (int n = 0; n < 100; ++n) rig.at(rig.work.plan().hook_W);
  EXPECT_EQ(rig.state.loop_m, 0);
  for (int n = 0; n < 300; ++n) rig.at(rig.work.plan().hook_W);
  EXPECT_NEAR(rig.state.loop_m, 0.020, 1e-12);
}

// Strokes of 20 mm beside the free end, on the table 12 mm under it.
void stroke(BenchRig& rig, std::size_t tendon, int strokes, double force_n) {
  const Vec3 free = rig.work.plan().tendons[tendon].free_W - Vec3(0, 0, 0.012);
  rig.hold(kBladeTool);
  rig.tool.contact_count = 1;
  rig.tool.force_W = Vec3(0, 0, force_n);
  rig.at(free + Vec3(0.006, 0, 0));
  for (int i = 0; i < strokes; ++i)
    for (int n = 1; n <= 100; ++n) {
      const double there = 0.0002 * (i % 2 == 0 ? n : 100 - n);
      rig.at(free + Vec3(0.006 + there, 0, 0));
    }
}

TEST(GraftBenchWork, StrokesOfThePressedBladeScrapeTheMuscleOff) {
  BenchRig rig;
  stroke(rig, 0, 3, 0.5);
  EXPECT_EQ(rig.state.tendons[0].scraped_m, 0);  // in the patient still
  rig.state.tendons[0].stripped = rig.state.tendons[1].stripped = true;
  EXPECT_EQ(rig.state.tendons[0].muscle_left(), 1);
  stroke(rig, 0, 3, 0.05);
  EXPECT_EQ(rig.state.tendons[0].scraped_m, 0);
  stroke(rig, 0, 2, 0.5);
  EXPECT_NEAR(rig.state.tendons[0].scraped_m, 0.040, 1e-9);
  EXPECT_NEAR(rig.state.tendons[0].muscle_left(), 1.0 / 3, 1e-6);
  EXPECT_EQ(rig.state.tendons[1].scraped_m, 0);
  // Lifted and set down elsewhere it has scraped nothing on the way.
  stroke(rig, 1, 1, 0.5);
  EXPECT_NEAR(rig.state.tendons[1].scraped_m, 0.020, 1e-9);
  stroke(rig, 0, 2, 0.5);
  EXPECT_EQ(rig.state.tendons[0].muscle_left(), 0);
}

TEST(GraftBenchWork, ANeedleHolderThatShutsAtAPlacePutsThreadThrough) {
  BenchRig rig;
  rig.state.tendons[0].stripped = true;
  rig.hold(kNeedleTool);
  const auto shut_at = [&](const Vec3& p_W) {
    rig.tool.jaw = 1;
    rig.at(p_W);
    rig.tool.jaw = 0;
    rig.at(p_W);
  };
  const GraftBenchPlan& plan = rig.work.plan();
  shut_at(stitch_W(plan, 1, 0));  // still in the patient
  EXPECT_EQ(rig.state.tendons[1].passes(), 0u);
  shut_at(stitch_W(plan, 0, 0));
  shut_at(stitch_W(plan, 0, 0));
  EXPECT_EQ(rig.state.tendons[0].passes(), 1u);
  shut_at(stitch_W(plan, 0, 2) + Vec3(0, 0.02, 0));
  EXPECT_EQ(rig.state.tendons[0].passes(), 1u);
  shut_at(stitch_W(plan, 0, 2));
  EXPECT_EQ(rig.state.tendons[0].stitches, 0b101u);
  rig.state.tendons[0].folds = 2;  // it lies open no longer
  shut_at(stitch_W(plan, 0, 3));
  EXPECT_EQ(rig.state.tendons[0].passes(), 2u);
}

TEST(GraftBenchWork, TheBoardPullsNoHarderThanTheThreadHolds) {
  BenchRig rig;
  rig.state = folded_bench(2, 2);
  rig.state.tendons[1].stitches = 0b11;
  rig.hold(kClampTool);
  rig.push(GraftBenchPlan::kBoard, 80 / GraftBenchWork::kLever, 5);
  EXPECT_NEAR(rig.state.tension_n, 2 * kStitchHolds_n, 1e-9);
  rig.state.tendons[1].stitches = 0;
  rig.push(GraftBenchPlan::kBoard, 80 / GraftBenchWork::kLever, 0.1);
  EXPECT_EQ(rig.state.tension_n, 0);
}

TEST(GraftBenchWork, OpenJawsLetTheSlideBackAndShutOnesDoNot) {
  BenchRig rig;
  rig.state = folded_bench(2, 2);
  rig.hold(kClampTool);
  rig.push(GraftBenchPlan::kBoard, 80 / GraftBenchWork::kLever, 5);
  const double front = rig.state.hands[0].front_m;
  const Vec3 from = rig.work.plan().board_from_W;
  rig.at(from + Vec3(0.5 * front, 0, 0));
  EXPECT_NEAR(rig.state.tension_n, 80, 2);
  rig.tool.jaw = 1;
  rig.at(from + Vec3(0.5 * front, 0, 0));
  EXPECT_NEAR(rig.state.tension_n, 40, 1);
  rig.at(from);
  EXPECT_EQ(rig.state.tension_n, 0);
}

TEST(GraftBenchWork, AGraftThatHangsInTheKneeHasLeftTheBench) {
  BenchRig rig;
  rig.state = folded_bench(2, 2);
  rig.state.tension_n = 80;
  rig.bones.placing.on = true;
  rig.bones.placing.phase = PlacingPhase::kThreadHeld;
  rig.step();
  EXPECT_GT(rig.state.creep_s, 0);
  rig.bones.placing.phase = PlacingPhase::kThreadOut;
  rig.step();
  const double crept = rig.state.creep_s;
  rig.hold(kButton20);
  for (int n = 0; n < 400; ++n) rig.at(rig.work.plan().hook_W);
  EXPECT_EQ(rig.state.creep_s, crept);
  EXPECT_EQ(rig.state.loop_m, 0);
  rig.hold(kSizer8);
  rig.at(rig.work.plan().graft_from_W);
  EXPECT_FALSE(rig.work.guides()[0].on);
}

TEST(GraftBenchWork, AToolOfAnotherEpochOrThatIsNoNumberDoesNothing) {
  BenchRig rig;
  rig.state.tendons[0].bands_cut = 0b11;
  rig.hold(kStripperTool);
  rig.push(0, 3.0, 0.2);
  const double front = rig.state.tendons[0].front_m;
  rig.bones.epoch = 1;
  rig.push(0, 3.0, 0.2);
  EXPECT_EQ(rig.state.tendons[0].front_m, front);
  EXPECT_FALSE(rig.work.guides()[0].on);
  rig.bones.epoch = 0;
  rig.tool.X_WP.p.x() = std::nan("");
  rig.step();
  EXPECT_FALSE(rig.work.guides()[0].on);
}

}  // namespace
}  // namespace osteon
