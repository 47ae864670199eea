// Two hands in one world: what they share, what they do to each other, and going back.
#include <gtest/gtest.h>

#include <array>

#include "count_allocations.h"
#include "osteon/base/random.h"
#include "session_fixtures.h"
#include "two_hands.h"

namespace osteon {
namespace {

using testing::allocations;
using testing::record_hands;
using testing::two_box_case;
using testing::two_hands;

// One bone, free on its springs.
std::shared_ptr<const Case> one_box() {
  CaseDef def;
  def.name = "one box";
  BoneDef bone;
  bone.name = "block";
  bone.mesh = testing::box_mesh(testing::kBoxHalf);
  def.bones.push_back(bone);
  auto built = build_case(std::move(def));
  return std::make_shared<const Case>(std::move(*built));
}

ToolInput at(const Vec3& p_W) {
  ToolInput input;
  input.X_WD.p = p_W;
  return input;
}

// Hands that come from both sides along x, down to `depth_m` behind the bone's faces.
std::array<HandInput, 2> squeeze(std::uint64_t n, double depth_m) {
  const double way = 0.004 * std::min(1.0, static_cast<double>(n) / 1000);
  const double x = testing::kBoxHalf.x() + 0.00075 + (0.004 - depth_m) - way;
  return {HandInput{at({-x, 0, 0}), {}}, HandInput{at({x, 0, 0}), {}}};
}

TEST(TwoHands, SqueezeABoneWithEqualAndOppositeForces) {
  Session session(one_box(), two_hands());
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    const Vec3 before = session.tool_state(0).force_W;
    (void)session.tick(squeeze(n, 0.0015));
    const Vec3& left = session.tool_state(0).force_W;
    const Vec3& right = session.tool_state(1).force_W;
    const double change = (left - before).norm();
    ASSERT_LE((left + right).norm(), change + 1e-6) << n;
  }
  // 1.5 mm deep; the tip's 32 corners reach a little less far than its radius.
  EXPECT_NEAR(session.tool_state(0).force_W.x(), -3.0, 0.12);
  EXPECT_LT((session.bones().bones[0].X_WB.p).norm(), 1e-6);
}

TEST(TwoHands, OneAloneMovesTheBoneThatBothHold) {
  Session session(one_box(), two_hands());
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    std::array<HandInput, 2> hands = squeeze(n, 0.0015);
    hands[1].input = at({0.1, 0, 0});
    (void)session.tick(hands);
  }
  EXPECT_GT(session.bones().bones[0].X_WB.p.x(), 1e-4);
  EXPECT_EQ(session.tool_state(1).force_W.norm(), 0);
}

// Above the bone the tips meet each other.
TEST(TwoHands, PushEachOtherWithEqualAndOppositeForces) {
  Session session(one_box(), two_hands());
  double most = 0;
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    const Vec3 before = session.tool_state(0).force_W;
    const double x = 0.004 - 0.0055 * std::min(1.0, static_cast<double>(n) / 1500);
    const std::array<HandInput, 2> hands{HandInput{at({-x, 0, 0.05}), {}},
                                         HandInput{at({x, 0, 0.05}), {}}};
    (void)session.tick(hands);
    const Vec3& left = session.tool_state(0).force_W;
    ASSERT_LE((left + session.tool_state(1).force_W).norm(), (left - before).norm() + 1e-6) << n;
    most = std::max(most, left.norm());
    // No tip has gone through the other.
    ASSERT_LE(session.tool_state(0).X_WP.p.x(), session.tool_state(1).X_WP.p.x()) << n;
  }
  // Hands 3 mm past each other, tips of 0.75 mm: each spring is stretched by 2.25 mm.
  EXPECT_NEAR(session.tool_state(0).force_W.x(), -2000 * 0.00225, 0.05);
  EXPECT_LT(session.tool_state(0).force_W.x(), 0);
  EXPECT_EQ(session.tool_state(0).tool_contact_count, 1u);
  EXPECT_EQ(session.tool_state(0).contact_count, 0u);
  EXPECT_LT(most, 5);
}

// A hand that is pushed while it holds still is pushed by what the other presses.
TEST(TwoHands, APushIsFeltByWhoHoldsStill) {
  Session session(one_box(), two_hands());
  for (std::uint64_t n = 1; n <= 2000; ++n) {
    const double x = -0.01 + 0.0095 * std::min(1.0, static_cast<double>(n) / 1500);
    const std::array<HandInput, 2> hands{HandInput{at({x, 0, 0.05}), {}},
                                         HandInput{at({0, 0, 0.05}), {}}};
    (void)session.tick(hands);
  }
  EXPECT_NEAR(session.tool_state(1).force_W.x(), 1.0, 0.02);
  EXPECT_NEAR(session.tool_state(0).force_W.x(), -1.0, 0.02);
}

TEST(TwoHands, OneHandOfTwoFarApartFeelsWhatItFeelsAlone) {
  const auto the_case = two_box_case();
  SessionSettings alone_settings = testing::moving_bones();
  Session alone(the_case, alone_settings);
  SessionSettings both = alone_settings;
  both.hands = {{"left", 0}, {"right", 0}};
  Session session(the_case, both);
  for (std::uint64_t n = 1; n <= 3000; ++n) {
    const Command command = testing::command_at(n);
    const std::array<HandInput, 2> hands{HandInput{testing::hand_at(n), command},
                                         HandInput{at({0, 0, 0.2}), {}}};
    (void)session.tick(hands);
    (void)alone.tick(testing::hand_at(n), command);
    ASSERT_EQ(session.tool_state(0).force_W, alone.tool_state(0).force_W) << n;
    ASSERT_EQ(session.tool_state(0).X_WP.p, alone.tool_state(0).X_WP.p) << n;
  }
}

TEST(TwoHands, AreRepeatedByAReplay) {
  const auto the_case = two_box_case();
  std::uint64_t hash = 0;
  const Recording recording = record_hands(the_case, 3, 3000, &hash);
  const auto outcome = replay(recording, the_case, ReplayOptions{});
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_TRUE(outcome->identical) << outcome->first_different_hand << " "
                                  << outcome->first_different_tick;
  EXPECT_EQ(outcome->state_hash, hash);
  EXPECT_EQ(outcome->ticks, 3000u);
  ASSERT_EQ(outcome->reports.size(), 2u);
  EXPECT_GT(outcome->reports[1].path_length_mm, 1);
}

TEST(TwoHands, ADifferenceOfTheSecondHandIsNamed) {
  const auto the_case = two_box_case();
  Recording recording = record_hands(the_case, 3, 1000);
  recording.more_hands[0][600].force_W.x() += 1e-12;
  const auto outcome = replay(recording, the_case, ReplayOptions{});
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->identical);
  EXPECT_EQ(outcome->first_different_hand, 1u);
  EXPECT_EQ(outcome->first_different_tick, 601u);
}

TEST(TwoHands, AllocateNothingWhateverHappens) {
  Session session(two_box_case(), two_hands(), testing::three_probes());
  testing::HandsAtRandom hands(5);
  std::uint64_t marks = 0, restored = 0, taken = 0;
  for (std::uint64_t n = 1; n <= 4000; ++n) {
    const std::array<HandInput, 2> inputs = hands.at(n);
    for (const HandInput& input : inputs) {
      marks += input.command.kind == CommandKind::kMark ? 1 : 0;
      restored += input.command.kind == CommandKind::kRestore ? 1 : 0;
      taken += input.command.kind == CommandKind::kTake ? 1 : 0;
    }
    const std::uint64_t before = allocations();
    (void)session.tick(inputs);
    ASSERT_EQ(allocations(), before) << n;
  }
  EXPECT_GT(marks, 3u);
  EXPECT_GT(restored, 3u);
  EXPECT_GT(taken, 3u);
}

}  // namespace
}  // namespace osteon
