// Thread and graft are moved by a hand: the way that is right, what is felt, and each way to fail.
#include "osteon/physics/graft_placing.h"

#include <gtest/gtest.h>

#include <limits>

#include "osteon/base/turn.h"
#include "osteon/scene/graft.h"

namespace osteon {
namespace {

enum PlacingTray : std::uint32_t { kPinTool, kPlacingClamp, kPlacingHook };

// A femur's tunnel along x from the joint's middle, a tibia's against it, bones elsewhere.
PlacingPlan placing_plan() {
  PlacingPlan plan;
  plan.femur = {0, Vec3(0, 0, 0), Vec3(0.040, 0, 0), 0.004};
  plan.tibia = {1, Vec3(-0.030, 0, 0), Vec3(-0.070, 0, 0), 0.004};
  plan.femur_bend_rad = 0.5;
  return plan;
}

Quat shaft_towards(const Vec3& handle_W) { return turn_between(Vec3::UnitZ(), handle_W); }

// The haptic half is played: a tool stands at its front with the force asked for.
struct PlacingRig {
  explicit PlacingRig(const PlacingPlan& plan = placing_plan()) : plan_(plan) {
    using Kind = PlacingTool::Kind;
    const std::vector<PlacingTool> tray{
        {Kind::kPassingPin}, {Kind::kClamp}, {Kind::kOther}, {Kind::kScrew, 0.009}};
    auto made = GraftPlacing::make(plan_, tray, 0.002);
    EXPECT_TRUE(made) << (made ? "" : made.error().message());
    work.emplace(std::move(*made));
    bones.count = 2;
    state = work->begin();
  }
  void step() {
    const ToolState* const tools[] = {&tool};
    work->step(tools, bones, state);
  }
  void take(std::uint32_t instrument) {
    tool.instrument = instrument;
    step();
    step();
  }
  void at(const Vec3& p_W, const Vec3& handle_W, double jaw) {
    tool.X_WP = {p_W, shaft_towards(handle_W)};
    tool.X_WD = tool.X_WP;
    tool.jaw = jaw;
    step();
  }
  // The pin in its tunnel, as far as `until` of the state says.
  void push_pin(double to_m, double force_n = 2) {
    if (tool.instrument != kPinTool || state.hands[0].line == PlacingLine::kNone) take(kPinTool);
    for (int n = 0; n < 4000 && state.pin_m < to_m; ++n) {
      tool.force_W =
          state.hands[0].line != PlacingLine::kNone ? Vec3(-force_n, 0, 0) : Vec3(Vec3::Zero());
      const std::uint32_t lost = state.lost;
      at(Vec3(state.pin_m, 0, 0), -Vec3::UnitX(), 0);
      if (state.lost != lost) break;
    }
    tool.force_W = Vec3::Zero();
  }
  // The clamp through the tibia takes the end, and opens at a place.
  void fetch_end(const Vec3& to_W, const Vec3& handle_W) {
    take(kPlacingClamp);
    at(state.end_W, handle_W, 1);
    at(state.end_W, handle_W, 0);
    at(to_W, handle_W, 0);
    at(to_W, handle_W, 1);
  }
  void take_thread() {
    at(Vec3(0.065, 0, 0), Vec3::UnitX(), 1);
    at(Vec3(0.065, 0, 0), Vec3::UnitX(), 0);
  }
  void draw(double force_n, double seconds) {
    tool.force_W = Vec3(-force_n, 0, 0);
    for (int n = 0; n < static_cast<int>(seconds / 0.002); ++n) step();
    tool.force_W = Vec3::Zero();
  }
  void let_go() { at(tool.X_WP.p, Vec3::UnitX(), 1); }
  void thread_out() {
    push_pin(0.055);
    fetch_end(Vec3(-0.090, 0, 0), -Vec3::UnitX());
  }
  PlacingPlan plan_;
  std::optional<GraftPlacing> work;
  BoneSnapshot bones;
  GraftPlacingState state;
  ToolState tool;
};

TEST(GraftPlacing, PinClampAndPullBringTheButtonOutAndItTurns) {
  PlacingRig rig;
  rig.push_pin(0.055);
  EXPECT_EQ(rig.state.phase, PlacingPhase::kThreadInside);
  rig.fetch_end(Vec3(-0.090, 0, 0), -Vec3::UnitX());
  ASSERT_EQ(rig.state.phase, PlacingPhase::kThreadOut);
  rig.take_thread();
  while (rig.state.drawn_m < rig.work->passed().end_m + 0.001) {
    const double before = rig.state.drawn_m;
    rig.draw(3.5, 0.01);
    ASSERT_GT(rig.state.drawn_m, before);
  }
  rig.let_go();
  EXPECT_EQ(rig.state.phase, PlacingPhase::kTurned);
  EXPECT_EQ(rig.state.gap_m, 0);
  EXPECT_EQ(rig.state.lost, 0u);
  EXPECT_EQ(rig.state.let_go_early, 0u);
  EXPECT_NEAR(rig.state.most_pull_n, 3.5 * GraftPlacing::kLever, 1e-9);
}

TEST(GraftPlacing, TheGraftGoesOnAboveItsResistanceOnly) {
  PlacingRig rig;
  rig.thread_out();
  rig.take_thread();
  PassingWay way;  // the same as the plan's
  way.femur_bend_rad = 0.5;
  const double r = passing_pull_n(way, DrawnGraft{}, 0) / GraftPlacing::kLever;
  EXPECT_DOUBLE_EQ(rig.work->resistance_n(PlacingLine::kDraw, 0), r);
  rig.draw(r - 0.01, 0.5);
  EXPECT_EQ(rig.state.drawn_m, 0);
  rig.draw(r + 0.15, 0.5);
  EXPECT_NEAR(rig.state.drawn_m, 0.5 * 0.15 / GraftPlacing::kSlow_n_s_per_m, 1e-4);
}

// What is felt of the flip: it grows harder over a short way, and falls when the button is out.
TEST(GraftPlacing, TheButtonIsFeltToComeOut) {
  const PlacingRig rig;
  const double out = rig.work->passed().end_m;
  const auto r = [&](double drawn) { return rig.work->resistance_n(PlacingLine::kDraw, drawn); };
  EXPECT_GT(r(out - 1e-5), r(out - 0.002) + 0.7);
  EXPECT_GT(r(out - 1e-5), r(out) + 0.7);
}

TEST(GraftPlacing, AThreadDrawnTooFarIsLostAndThePinGoesInAgain) {
  PlacingRig rig;
  rig.push_pin(1);
  EXPECT_EQ(rig.state.phase, PlacingPhase::kEmpty);
  EXPECT_EQ(rig.state.lost, 1u);
  rig.take(kPlacingHook);
  rig.push_pin(0.055);
  EXPECT_EQ(rig.state.phase, PlacingPhase::kThreadInside);
  EXPECT_EQ(rig.state.lost, 1u);
}

TEST(GraftPlacing, AnEndIsTakenThroughTheTibiaAloneAndLostOutsideOfIt) {
  PlacingRig rig;
  rig.push_pin(0.055);
  const Vec3 portal = Vec3(-0.3, 0, 1).normalized();
  rig.fetch_end(Vec3(-0.02, 0, 0.05), portal);  // does not take it
  EXPECT_EQ(rig.state.phase, PlacingPhase::kThreadInside);
  rig.fetch_end(Vec3(-0.020, 0, 0), -Vec3::UnitX());  // lets it go in the joint
  EXPECT_EQ(rig.state.phase, PlacingPhase::kThreadInside);
  EXPECT_EQ(rig.state.end_W, Vec3(-0.020, 0, 0));
  rig.fetch_end(Vec3(-0.060, 0, 0), -Vec3::UnitX());  // and in the tunnel
  EXPECT_EQ(rig.state.phase, PlacingPhase::kEmpty);
  EXPECT_EQ(rig.state.lost, 1u);
}

TEST(GraftPlacing, LetGoTooSoonItHasNotTurnedAndDrawnTooFarTissueLiesUnderIt) {
  PlacingRig rig;
  rig.thread_out();
  rig.take_thread();
  while (rig.state.drawn_m < rig.work->passed().end_m - 0.004) rig.draw(3, 0.01);
  rig.let_go();
  EXPECT_EQ(rig.state.phase, PlacingPhase::kThreadOut);
  EXPECT_EQ(rig.state.let_go_early, 1u);
  rig.take_thread();
  rig.draw(4, 3);
  EXPECT_DOUBLE_EQ(rig.state.drawn_m, rig.work->passed().end_m + GraftPlacing::kOverdraw_m);
  rig.let_go();
  EXPECT_EQ(rig.state.phase, PlacingPhase::kTurned);
  EXPECT_NEAR(rig.state.gap_m, GraftPlacing::kOverdraw_m - GraftPlacing::kFree_m, 1e-12);
}

// With a loop too short the graft stands at the socket's end: no pull brings the button out.
TEST(GraftPlacing, AGraftThatStandsFeelsLikeAWall) {
  PlacingPlan plan = placing_plan();
  plan.loop_m = 0.015;
  PlacingRig rig(plan);
  ASSERT_FALSE(rig.work->passed().turns);
  rig.thread_out();
  rig.take_thread();
  rig.draw(8, 4);
  EXPECT_DOUBLE_EQ(rig.state.drawn_m, rig.work->passed().end_m);
  EXPECT_NEAR(rig.state.most_pull_n, 8 * GraftPlacing::kLever, 1e-9);
  rig.let_go();
  EXPECT_EQ(rig.state.phase, PlacingPhase::kThreadOut);
  EXPECT_EQ(rig.state.let_go_early, 1u);
}

TEST(GraftPlacing, OddToolsAndPlansAreRefused) {
  PlacingRig rig;
  rig.thread_out();
  rig.take_thread();
  rig.tool.force_W = Vec3(-std::numeric_limits<double>::quiet_NaN(), 0, 0);
  rig.step();
  EXPECT_EQ(rig.state.drawn_m, 0);
  rig.tool.force_W = Vec3(-4, 0, 0);
  rig.tool.epoch = 1;
  rig.step();
  EXPECT_EQ(rig.state.drawn_m, 0);
  PlacingPlan odd = placing_plan();
  odd.tibia.outer_B = odd.tibia.mouth_B;
  EXPECT_FALSE(GraftPlacing::make(odd, {}, 0.002));
  odd = placing_plan();
  odd.graft_m = 0.009;
  EXPECT_FALSE(GraftPlacing::make(odd, {}, 0.002));
}

TEST(GraftPlacing, ARestorePointLetsGoOfWhatAHandHeld) {
  PlacingRig rig;
  rig.push_pin(0.055);
  rig.take(kPlacingClamp);
  rig.at(rig.state.end_W, -Vec3::UnitX(), 1);
  rig.at(rig.state.end_W, -Vec3::UnitX(), 0);
  ASSERT_EQ(rig.state.phase, PlacingPhase::kThreadHeld);
  rig.state = GraftPlacing::gone_back(rig.state);
  EXPECT_EQ(rig.state.phase, PlacingPhase::kThreadInside);
  rig.fetch_end(Vec3(-0.090, 0, 0), -Vec3::UnitX());
  EXPECT_EQ(rig.state.phase, PlacingPhase::kThreadOut);
}

// In the rig of a turned button the screw stands at the tibia's outer mouth.
struct ScrewRig : PlacingRig {
  static constexpr std::uint32_t kScrewTool = 3;
  ScrewRig() {
    state.phase = PlacingPhase::kTurned;
    take(kScrewTool);
  }
  void stand(double in_m, const Vec3& handle_W, double power, double force_n) {
    const Vec3 mouth(-0.070, 0, 0);
    tool.power = power;
    tool.force_W = force_n * handle_W.normalized();
    at(mouth - in_m * handle_W.normalized(), handle_W, 0);
  }
  void turn_in(double to_m, const Vec3& handle_W) {
    for (int n = 0; n < 20000 && state.screw.in_m < to_m; ++n)
      stand(state.screw.in_m, handle_W, 1, 1.5);
  }
};

TEST(GraftPlacing, AScrewGoesInByItsPitchAndStaysWhenTheHandTakesSomethingElse) {
  ScrewRig rig;
  const Vec3 out = -Vec3::UnitX();
  rig.stand(0, out, 0, 2);  // pressed, not turned
  EXPECT_EQ(rig.state.screw.screws, 0u);
  GraftPlacing::pull(90, rig.state);
  rig.bones.bend.on = true;
  for (int n = 0; n < 22; ++n) {
    ++rig.bones.bend.cycles;
    rig.step();
  }
  GraftPlacing::pull(5, rig.state);  // too little to work the creep out
  ++rig.bones.bend.cycles;
  rig.step();
  GraftPlacing::pull(90, rig.state);
  rig.bones.bend.now_deg = 30;
  rig.stand(0, out, 1, 1.5);
  ASSERT_EQ(rig.state.screw.screws, 1u);
  const int steps = static_cast<int>(2 / 0.002);
  for (int n = 0; n < steps; ++n) rig.stand(rig.state.screw.in_m, out, 1, 1.5);
  EXPECT_NEAR(rig.state.screw.in_m, 2 * GraftPlacing::kScrewTurn_m_per_s, 1e-5);
  for (int n = 0; n < 100; ++n) rig.stand(rig.state.screw.in_m, out, 1, 0.2);
  EXPECT_NEAR(rig.state.screw.in_m, 2 * GraftPlacing::kScrewTurn_m_per_s, 1e-5);
  rig.turn_in(0.020, out);
  rig.take(kPlacingClamp);
  const PlacingScrew& screw = rig.state.screw;
  EXPECT_TRUE(screw.done);
  EXPECT_NEAR(screw.in_m, 0.020, 1e-4);
  EXPECT_EQ(screw.width_m, 0.009);
  EXPECT_EQ(screw.tension_n, 90);
  EXPECT_EQ(screw.cycles, 22u);
  EXPECT_EQ(screw.flexion_deg, 30);
  GraftPlacing::pull(0, rig.state);
  EXPECT_EQ(rig.state.tension_n, 90);
}

// A wide screw before an oblique mouth touches the rim 9 mm before the middle of the mouth.
TEST(GraftPlacing, AScrewBeginsWhereItTouchesTheRimAndNotFarBeforeIt) {
  const Vec3 out = -Vec3::UnitX();
  ScrewRig far;
  far.stand(-0.014, out, 1, 1.5);
  EXPECT_EQ(far.state.screw.screws, 0u);
  ScrewRig rim;
  rim.stand(-0.009, out, 1, 1.5);
  EXPECT_EQ(rim.state.screw.screws, 1u);
}

TEST(GraftPlacing, AScrewKeepsTheLineOnWhichItBeganAndNeedsFiveMillimetres) {
  ScrewRig rig;
  const Vec3 aside = Vec3(-std::cos(0.4), std::sin(0.4), 0);
  rig.stand(0, aside, 1, 1.5);
  rig.turn_in(0.003, aside);
  rig.take(kPlacingClamp);
  EXPECT_EQ(rig.state.screw.screws, 0u);
  EXPECT_FALSE(rig.state.screw.done);
  rig.tool.power = 0;
  rig.take(ScrewRig::kScrewTool);
  rig.stand(0, aside, 1, 1.5);
  rig.turn_in(0.010, aside);
  std::array<ToolGuide, kMaxHands> guides{};
  rig.work->lead(rig.state, guides);
  EXPECT_NEAR((guides[0].nhat_B - aside).norm(), 0, 1e-9);
  EXPECT_NEAR(guides[0].stop_m, -rig.state.screw.in_m, 1e-12);
  rig.take(kPlacingClamp);
  EXPECT_NEAR(std::acos(rig.state.screw.out_B.dot(-Vec3::UnitX())), 0.4, 1e-9);
  // Too flat along the bone it does not begin; nor before the button has turned.
  ScrewRig flat;
  flat.stand(0, Vec3(-0.3, 1, 0), 1, 1.5);
  EXPECT_EQ(flat.state.screw.screws, 0u);
  ScrewRig early;
  early.state.phase = PlacingPhase::kThreadOut;
  early.stand(0, -Vec3::UnitX(), 1, 1.5);
  EXPECT_EQ(early.state.screw.screws, 0u);
  GraftPlacing::pull(90, early.state);
  EXPECT_EQ(early.state.tension_n, 0);
}

}  // namespace
}  // namespace osteon
