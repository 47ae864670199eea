// A stump that is cleared in a session: two blocks on bones, with the shipped instruments.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "driven_hand.h"
#include "osteon/physics/soft_cut_state.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "stump_fixtures.h"

namespace osteon {
namespace {

using testing::begin_recording;
using testing::DrivenHand;
using testing::kStumpHalf;
using testing::posed;
using testing::stump_run;
using testing::StumpRun;

enum : std::uint32_t { kShaver, kHook, kAblator, kPunch, kDrill };

const Quat kFromAbove = posed(Vec3::UnitY(), Vec3::UnitZ());

struct ClearingHand : DrivenHand {
  explicit ClearingHand(Session& s) : DrivenHand(s, {0, 0, 0.018}, kFromAbove) {}

  void take(std::uint32_t instrument, double power) {
    DrivenHand::take(instrument);
    tick({CommandKind::kPower, power});
  }
  double cleared(std::size_t stump = 0) const { return session.softs()->cleared_percent(stump); }
  double removed_mm3(std::size_t stump = 0) const {
    return 1e9 * session.softs()->removed_m3(stump);
  }
};

// Upright plunges side by side, each down to `to_z`.
void mow(ClearingHand& hand, double to_z, int plunges = 4) {
  for (int i = 0; i < plunges; ++i)
    for (int k = 0; k < plunges; ++k) {
      const double step = 2 * kStumpHalf.x() / (plunges - 1);
      const Vec3 over(-kStumpHalf.x() + i * step, -kStumpHalf.y() + k * step, 0.014);
      hand.move(over, 60);
      hand.move({over.x(), over.y(), to_z}, 700);
      hand.move(over, 80);
    }
}

TEST(SoftClear, NobodyPressesAStumpThatATipHasNotReached) {
  Session session = stump_run().session();
  ClearingHand hand(session);
  hand.take(kHook, 0);
  hand.move({0, 0, 2 * kStumpHalf.z() + 0.0025}, 300);
  const SolidHandState near = session.save().world.softs.solid_hands[0];
  ASSERT_GT(near.count, 0u);
  for (std::uint32_t i = 0; i < near.count; ++i) {
    EXPECT_LT(near.near[i].deep_m, 0);
    EXPECT_EQ(near.near[i].contact.others_m, 0);
  }
}

// A wall of 2 mm is left of the block. Two rods that come together like a roof press it from both
// sides, ever harder: each sends the wall towards the other.
TEST(SoftClear, PartsOfAToolOnBothSidesDoNotDriveEachOthersForceUp) {
  const auto& run = stump_run();
  Session session = run.session();
  ClearingHand hand(session);
  hand.take(kDrill, 1);
  for (const double x : {-0.00505, 0.00505})
    for (const double y : {-0.0035, 0.0, 0.0035}) {
      hand.move({x, y, 0.014}, 60);
      hand.move({x, y, 0.002}, 700);
      hand.move({x, y, 0.014}, 60);
    }
  hand.rest(1000);
  SoftState walls = session.save().world.softs;
  walls.hands = {};
  walls.solid_hands = {};
  Tool roof;
  for (const double side : {-1.0, 1.0})
    roof.parts.push_back(make_rod({side * 0.003, 0, 0}, {side * 0.001, 0, 0.012}, 0.0008));
  const std::vector<std::shared_ptr<const Tool>> tray{std::make_shared<const Tool>(roof)};
  SoftWorld softs(run.softs, tray, 2000, 40, 0.002);
  ASSERT_TRUE(softs.fits(walls));
  softs.restore(walls, 0);
  BoneSnapshot bones;
  bones.count = 2;
  for (std::size_t b = 0; b < 2; ++b) bones.bones[b].X_WB = run.the_case->bones[b].X_WB;
  ToolState tool;
  tool.tick = 1;
  double most_n = 0;
  for (int n = 0; n < 600; ++n) {
    ++bones.step;
    tool.X_WP.p.z() = std::max(0.003, 0.012 - 1.5e-5 * n);
    const ToolState* const one = &tool;
    softs.step(std::span(&one, 1), bones);
    const SolidHandState& state = softs.state().solid_hands[0];
    for (std::uint32_t i = 0; i < state.count; ++i) {
      const SolidNear& near = state.near[i];
      const double own_n = near.contact.stiffness_n_per_m * std::max(0.0, near.deep_m);
      ASSERT_LE(near.force_n, 2 * own_n + 1e-9) << n;
      most_n = std::max(most_n, near.force_n);
    }
  }
  EXPECT_GT(most_n, 0.02);
}

TEST(SoftClear, NothingGoesWithoutPower) {
  Session session = stump_run().session();
  ClearingHand hand(session);
  hand.take(kShaver, 0);
  hand.move({0, 0, 0.009}, 500);
  EXPECT_GT(session.tool_state().force_W.z(), 1);
  EXPECT_EQ(hand.cleared(), 0);
  EXPECT_EQ(hand.removed_mm3(), 0);
}

// Full power takes 8 mm a second, half of it 4, of a hand that presses 8 mm deep: once the round
// end is in, a cylinder as wide as it is.
TEST(SoftClear, ItGoesAsFastAsTheInstrumentClears) {
  constexpr double kPressed_m = 0.008, kClears_mm_per_s = 8, kWatched_s = 0.2;
  constexpr double kRadius_mm = 2.1 + 1e3 * kClearRoom_m;
  for (const double power : {0.5, 1.0}) {
    Session session = stump_run().session();
    ClearingHand hand(session);
    hand.take(kShaver, power);
    hand.move({0, 0, 2 * kStumpHalf.z()}, 300);
    hand.move({0, 0, 2 * kStumpHalf.z() - kPressed_m}, 400);
    hand.rest(200);
    const double before_mm3 = hand.removed_mm3();
    hand.rest(static_cast<int>(1000 * kWatched_s));
    const double passed_mm3 =
        std::numbers::pi * kRadius_mm * kRadius_mm * power * kClears_mm_per_s * kWatched_s;
    EXPECT_NEAR(hand.removed_mm3() - before_mm3, passed_mm3, 0.03 * passed_mm3) << power;
  }
}

// A slow drill takes as much by strides as in every step, with fewer looks at the stump.
TEST(SoftClear, ByStridesItTakesAsMuch) {
  StumpRun by_strides;
  SoftSetup setup = *by_strides.softs;
  let_clearing_go_by_strides(setup);
  ASSERT_TRUE(setup.clears_by_strides);
  by_strides.settings.soft_hash = setup.hash;
  by_strides.softs = std::make_shared<const SoftSetup>(std::move(setup));
  const auto drill = [](const StumpRun& run) {
    Session session = run.session();
    ClearingHand hand(session);
    hand.take(kDrill, 1);
    hand.move({0, 0, 0.012}, 300);
    hand.move({0, 0, 0.009}, 3000);
    const auto state = session.save();
    return std::pair(hand.removed_mm3(), state.world.softs.cut->solids[0].cuts.step);
  };
  const auto [every_mm3, every_looks] = drill(stump_run());
  const auto [strides_mm3, strides_looks] = drill(by_strides);
  EXPECT_GT(every_mm3, 50);
  EXPECT_NEAR(strides_mm3, every_mm3, 0.01 * every_mm3);
  EXPECT_LT(strides_looks, every_looks / 2);
}

TEST(SoftClear, ByStridesOnlyWhereSomethingClears) {
  SoftSetup setup = *stump_run().softs;
  for (auto& with : setup.cutters)
    if (with && with->way == SolidCutter::Way::kClear) with.reset();
  const std::uint64_t before = setup.hash;
  let_clearing_go_by_strides(setup);
  EXPECT_FALSE(setup.clears_by_strides);
  EXPECT_EQ(setup.hash, before);
}

TEST(SoftClear, MownDownItIsClearedAndTheFootprintStays) {
  Session session = stump_run().session();
  ClearingHand hand(session);
  hand.take(kDrill, 1);
  mow(hand, 0.0016);
  hand.rest(60);
  EXPECT_GT(hand.cleared(), 90);
  EXPECT_EQ(hand.cleared(1), 0);
  EXPECT_NEAR(session.bones().softs.cleared_percent, 0.5 * hand.cleared(), 1);
  // 10 x 10 mm: at least half of the lowest 1.5 mm are left on the bone.
  EXPECT_LT(hand.removed_mm3(), 10 * 10 * 12 - 0.5 * 10 * 10 * 1.5);
  std::vector<double> told;
  for (const Event& event : hand.events)
    if (event.kind == kSoftCleared) told.push_back(event.values[0]);
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GT(told.back(), 89);
}

// Its window looks to +y of Tool: what lies behind its back stays.
TEST(SoftClear, TheBackOfTheShaverTakesNothing) {
  const auto taken = [](const Vec3& window_W) {
    Session session = stump_run().session();
    ClearingHand hand(session);
    hand.q = posed(window_W, Vec3::UnitZ());
    hand.at = {0, 0.012, 0.003};
    hand.take(kShaver, 1);
    hand.move({0, 0.005, 0.003}, 1500);
    return hand.removed_mm3();
  };
  EXPECT_GT(taken(-Vec3::UnitY()), 5);
  EXPECT_EQ(taken(Vec3::UnitY()), 0);
}

TEST(SoftClear, TheAblatorAndADrillClearTooAHookDoesNot) {
  for (const std::uint32_t tool : {kHook, kAblator, kDrill}) {
    Session session = stump_run().session();
    ClearingHand hand(session);
    hand.take(tool, 1);
    hand.move({0, 0, 0.010}, 800);
    if (tool == kHook)
      EXPECT_EQ(hand.removed_mm3(), 0);
    else
      EXPECT_GT(hand.removed_mm3(), 3) << tool;
  }
}

// Cut across half way up: what is above has no hold, what is below hangs on the bone.
TEST(SoftClear, WhatIsCutOffFloatsAwayAndCountsAsCleared) {
  Session session = stump_run().session();
  ClearingHand hand(session);
  // Lying along x, its window to the block, drawn through it from y = 10 to -10 mm: one half, then
  // the other.
  hand.take(kShaver, 1);
  for (const double side : {-1.0, 1.0}) {
    hand.q = posed(-Vec3::UnitY(), side * Vec3::UnitX());
    hand.at = {-side * 0.0005, 0.010, 0.004};
    hand.move({-side * 0.0005, -0.010, 0.004}, 6000);
  }
  hand.rest(100);
  EXPECT_EQ(session.softs()->pieces(0), 1u);
  EXPECT_GT(hand.cleared(), 85);
  EXPECT_LT(hand.removed_mm3(), 10 * 10 * 11);
}

TEST(SoftClear, AStateGoesOnTheSameAndUndoBringsItBack) {
  Session session = stump_run().session();
  ClearingHand hand(session);
  hand.rest(10);
  hand.tick({CommandKind::kMark, 0});
  hand.rest(10);
  hand.take(kShaver, 1);
  hand.move({0, 0, 0.0085}, 900);
  const double half_way = hand.cleared();
  EXPECT_GT(half_way, 1);
  const auto bytes = to_bytes(session.save());
  const auto back = state_from_bytes(bytes);
  ASSERT_TRUE(back) << back.error().message();
  Session other = stump_run().session();
  ASSERT_TRUE(other.restore(*back));
  EXPECT_EQ(other.state_hash(), session.state_hash());
  ClearingHand second(other);
  second.at = hand.at;
  hand.events.clear();
  for (ClearingHand* h : {&hand, &second}) h->move({0.002, 0.001, 0.004}, 900);
  EXPECT_EQ(other.state_hash(), session.state_hash());
  EXPECT_EQ(second.cleared(), hand.cleared());
  EXPECT_GT(hand.cleared(), half_way);
  EXPECT_EQ(second.events.size(), hand.events.size());
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(10);
  EXPECT_EQ(hand.cleared(), 0);
  EXPECT_EQ(session.bones().softs.cleared_percent, 0);
}

TEST(SoftClear, AReplayClearsTheSame) {
  const auto& run = stump_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  ClearingHand hand(session);
  hand.into = &recording;
  hand.take(kShaver, 1);
  hand.move({0, 0, 0.0085}, 900);
  hand.take(kPunch, 0);
  hand.tick({CommandKind::kJaw, 1});
  hand.move({0, 0, 0.010}, 300);
  hand.tick({CommandKind::kJaw, 0});
  hand.rest(30);
  recording.complete = true;
  ReplayOptions options;
  options.tray = run.tray;
  options.softs = run.softs;
  const auto outcome = replay(recording, run.the_case, options);
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << outcome->first_different_tick;
  EXPECT_EQ(outcome->state_hash, session.state_hash());
}

}  // namespace
}  // namespace osteon
