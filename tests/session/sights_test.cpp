// What lies in the middle of a scope's picture is an event.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "count_allocations.h"
#include "osteon/base/random.h"
#include "osteon/collide/primitive.h"
#include "scope_gaze.h"
#include "session_fixtures.h"

namespace osteon {
namespace {

using testing::kBoxHalf;

// A scope that looks along its shaft, or askew: at identity it looks down.
Tool scope(double angle_deg) {
  Tool tool;
  tool.name = "scope";
  tool.parts.push_back(make_rod(Vec3::Zero(), Vec3(0, 0, 0.1), 0.001));
  tool.optics = ToolOptics{angle_deg * std::numbers::pi / 180, 0.9};
  return tool;
}

Tray probe_and_scope(double angle_deg = 0) {
  return {std::make_shared<const Tool>(make_wrist_probe()),
          std::make_shared<const Tool>(scope(angle_deg))};
}

SessionSettings with_scope() {
  SessionSettings settings;
  settings.hands = {{"left", 1}};
  settings.tray = {"wrist_probe", "scope"};
  return settings;
}

ToolInput at(const Vec3& p_W, const Quat& q = Quat::Identity()) {
  ToolInput input;
  input.X_WD = {p_W, q};
  return input;
}

// Over the left box, over the right one, and where there is nothing.
const Vec3 kOverLeft(0, 0, 0.03), kOverRight(0.024, 0, 0.03), kBeside(0, 0.05, 0.03);

// Stays there for so many ticks; what is seen.
std::vector<Event> look(Session& session, const Vec3& p_W, int ticks,
                        const Quat& q = Quat::Identity()) {
  std::vector<Event> seen;
  for (int n = 0; n < ticks; ++n) {
    (void)session.tick(at(p_W, q));
    for (const Event& event : session.last_events())
      if (event.kind == EventKind::kStructureSeen) seen.push_back(event);
  }
  return seen;
}

TEST(Sights, WithoutAScopeNothingIsSeen) {
  SessionSettings settings = with_scope();
  settings.hands[0].instrument = 0;
  Session session(testing::two_box_case(), settings, probe_and_scope());
  EXPECT_TRUE(look(session, kOverLeft, 200).empty());
}

TEST(Sights, WhatIsFarOrNotThereIsNotSeen) {
  Session session(testing::two_box_case(), with_scope(), probe_and_scope());
  EXPECT_TRUE(look(session, kBeside, 200).empty());
  const Vec3 far(0, 0, kBoxHalf.z() + ScopeGaze::kFarthest_m + 0.001);
  EXPECT_TRUE(look(session, far, 200).empty());
}

TEST(Sights, ABoneInTheMiddleIsToldOnceWithItsDistance) {
  Session session(testing::two_box_case(), with_scope(), probe_and_scope());
  const std::vector<Event> seen = look(session, kOverLeft, 1000);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].subject_kind, SubjectKind::kBone);
  EXPECT_EQ(seen[0].subject, 0u);
  EXPECT_EQ(seen[0].hand, 0);
  EXPECT_LE(seen[0].tick, 50u);
  EXPECT_NEAR(seen[0].values[0], 24, 1e-6);  // mm
  EXPECT_LT((seen[0].p_W - Vec3(0, 0, kBoxHalf.z())).norm(), 1e-9);
}

TEST(Sights, AnotherBoneIsToldAndTheFirstAnewAfterTwoSeconds) {
  Session session(testing::two_box_case(), with_scope(), probe_and_scope());
  EXPECT_EQ(look(session, kOverLeft, 500).size(), 1u);
  const std::vector<Event> other = look(session, kOverRight, 500);
  ASSERT_EQ(other.size(), 1u);
  EXPECT_EQ(other[0].subject, 1u);
  EXPECT_TRUE(look(session, kOverLeft, 500).empty());
  EXPECT_TRUE(look(session, kBeside, 2100).empty());
  EXPECT_EQ(look(session, kOverLeft, 500).size(), 1u);
}

TEST(Sights, TheNearerBoneHidesTheFarther) {
  Session session(testing::two_box_case(), with_scope(), probe_and_scope());
  // From the left, level with both boxes: the view goes along +x.
  const Quat level(std::sqrt(0.5), 0, -std::sqrt(0.5), 0);
  const std::vector<Event> seen = look(session, Vec3(-0.03, 0, 0), 300, level);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].subject, 0u);
  EXPECT_NEAR(seen[0].values[0], 20, 1e-6);
}

TEST(Sights, AnAngledScopeSeesBesideItsShaft) {
  Session session(testing::two_box_case(), with_scope(), probe_and_scope(45));
  // 24 mm above the box, it looks 24 mm beside, where there is none.
  EXPECT_TRUE(look(session, kOverLeft, 200).empty());
  const std::vector<Event> seen = look(session, kOverLeft - Vec3(0, 0.024, 0), 200);
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_NEAR(seen[0].values[0], 24 * std::sqrt(2.0), 1e-6);
}

TEST(Sights, ARunWithoutThemIsAsItWasBeforeThereWereAny) {
  SessionSettings settings = with_scope();
  settings.sights = false;
  Session session(testing::two_box_case(), settings, probe_and_scope());
  EXPECT_TRUE(look(session, kOverLeft, 200).empty());
  EXPECT_EQ(session.save().hands[0].watch.seen, (std::array<std::uint64_t, kMaxBones>{}));
  const std::string text = to_json(settings);
  EXPECT_FALSE(parse_settings(text)->sights);
  const std::size_t from = text.find("  \"sights\"");
  ASSERT_NE(from, std::string::npos);
  const std::string older = text.substr(0, from) + text.substr(text.find('\n', from) + 1);
  EXPECT_FALSE(parse_settings(older)->sights);
  settings.sights = true;
  EXPECT_TRUE(parse_settings(to_json(settings))->sights);
}

TEST(Sights, AStateGoesOnAsItWasAndATickAllocatesNothing) {
  Session session(testing::two_box_case(), with_scope(), probe_and_scope());
  EXPECT_EQ(look(session, kOverLeft, 500).size(), 1u);
  Session other(testing::two_box_case(), with_scope(), probe_and_scope());
  const auto state = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(state);
  ASSERT_TRUE(other.restore(*state));
  EXPECT_EQ(other.state_hash(), session.state_hash());
  // What was seen is remembered.
  EXPECT_TRUE(look(other, kOverLeft, 500).empty());
  EXPECT_TRUE(look(session, kOverLeft, 500).empty());
  EXPECT_EQ(other.state_hash(), session.state_hash());
  const std::uint64_t before = testing::allocations();
  for (int n = 0; n < 200; ++n) (void)session.tick(at(n < 100 ? kOverLeft : kOverRight));
  EXPECT_EQ(testing::allocations(), before);
}

// Rays at random against marching along them.
TEST(ScopeGaze, TheNearestBoneIsThatOfASlowSearch) {
  const auto the_case = testing::two_box_case();
  const ScopeGaze gaze(*the_case);
  BoneSnapshot bones;
  bones.count = 2;
  Random random(4);
  bones.bones[0].X_WB = {Vec3(0.01, 0, 0), random.rotation()};
  bones.bones[1].X_WB = {Vec3(-0.015, 0.01, 0), random.rotation()};
  int hits = 0, grazes = 0;
  for (int i = 0; i < 1200; ++i) {
    ScopeView view;
    view.eye_W = 0.05 * random.direction();
    view.along_W = (0.02 * random.direction() - view.eye_W).normalized();
    std::uint32_t bone = kNoSubject;
    double at = 0;
    for (; at < ScopeGaze::kFarthest_m && bone == kNoSubject; at += 5e-5)
      for (std::uint32_t b = 0; b < 2; ++b) {
        const Vec3 p_B = bones.bones[b].X_WB.inverse() * Vec3(view.eye_W + at * view.along_W);
        if ((p_B.cwiseAbs() - kBoxHalf).maxCoeff() < 0) bone = b;
      }
    const ScopeGaze::Seen seen = gaze.middle_of(view, bones);
    if (seen.bone == kNoSubject && bone == kNoSubject) continue;
    if (seen.bone != bone) {  // it grazes an edge before, between two steps
      ASSERT_NE(seen.bone, kNoSubject) << i;
      ASSERT_LT(seen.distance_m, at) << i;
      ++grazes;
      continue;
    }
    ++hits;
    ASSERT_NEAR(seen.distance_m, at, 1.1e-4) << i;
  }
  EXPECT_GT(hits, 300);
  EXPECT_LT(grazes, 10);
}

}  // namespace
}  // namespace osteon
