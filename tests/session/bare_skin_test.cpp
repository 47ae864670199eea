// Skin that is felt no more once its portals are made.
#include <algorithm>

#include "osteon/physics/skin_state.h"
#include "osteon/physics/soft_world.h"
#include "osteon/scene/soft_events.h"
#include "recorded_run.h"
#include "skin_fixtures.h"

namespace osteon {
namespace {

using testing::begin_recording;
using testing::expect_same_replays;
using testing::kSkinBall;
using testing::kSkinScope;
using testing::kSkinTrocar;
using testing::skin_run;
using testing::SkinHandAt;
using testing::SkinRun;

void go_through(SkinHandAt& hand, double x, double y) {
  hand.take(kSkinTrocar, {x, y, 0.010});
  hand.move({x, y, -0.030}, 1000);
  hand.rest(100);
  hand.move({x, y, 0.010}, 600);
  hand.rest(100);
}

double pressed_by_ball(SkinHandAt& hand, double x, double y) {
  hand.take(kSkinBall, {x, y, 0.010});
  hand.move({x, y, -0.004}, 200);
  hand.rest(50);
  const double force_n = hand.session.tool_state().force_W.z();
  hand.move({x, y, 0.010}, 100);
  return force_n;
}

TEST(BareSkin, WithoutAPortalItIsStillFelt) {
  Session session = skin_run().session(), plain = skin_run().session();
  SkinHandAt hand(session), other(plain);
  hand.tick({CommandKind::kBareSkin, 0});
  other.tick();
  const double force_n = pressed_by_ball(hand, 0, 0);
  EXPECT_GT(force_n, 1);
  EXPECT_EQ(force_n, pressed_by_ball(other, 0, 0));
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.move({0, 0, -0.010}, 500);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
}

TEST(BareSkin, ASessionWithoutSkinDoesNotMind) {
  const auto& run = skin_run();
  SessionSettings settings = run.settings;
  settings.soft.clear();
  settings.soft_hash = 0;
  Session session(run.the_case, settings, run.tray);
  SkinHandAt hand(session);
  hand.tick({CommandKind::kBareSkin, 0});
  EXPECT_EQ(pressed_by_ball(hand, 0, 0), 0);
}

TEST(BareSkin, OnceAPortalIsThereNothingElseOfTheSkinIsFelt) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.tick();
  go_through(hand, 0.003, 0.004);
  EXPECT_GT(pressed_by_ball(hand, -0.006, -0.004), 1);  // it was not said yet
  hand.tick({CommandKind::kBareSkin, 0});
  EXPECT_EQ(pressed_by_ball(hand, -0.006, -0.004), 0);
  // Any shaft goes in beside it, as in a portal of the case, without a peak.
  hand.take(kSkinScope, {0.005, 0.003, 0.010});
  hand.force_z.clear();
  hand.move({0.005, 0.003, -0.020}, 800);
  hand.rest(200);
  EXPECT_EQ(session.tool_state().portal, 0u);
  EXPECT_LT((session.tool_state().p_portal_W - Vec3(0.003, 0.004, 0)).norm(), 1e-4);
  EXPECT_EQ(session.tool_state().portal_way, 0u);  // it is not made anew
  EXPECT_LT(*std::max_element(hand.force_z.begin(), hand.force_z.end()), 2.5);
  hand.move({0.030, 0.003, -0.018}, 400);
  EXPECT_EQ(session.tool_state().portal, 0u);
  EXPECT_GT(session.tool_state().force_W.norm(), 0.2);
  hand.move({0.003, 0.004, 0.010}, 600);
  hand.rest(200);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
  // Far from it there is no way in that counts as one.
  hand.move({-0.009, -0.009, 0.010}, 200);
  hand.move({-0.009, -0.009, -0.020}, 400);
  EXPECT_EQ(session.tool_state().portal, kNoPortal);
  EXPECT_EQ(hand.count(kPortalMade), 1u);
}

// The shaft stays in the hole that it has made; what was felt of the rim the portal has taken over.
TEST(BareSkin, AShaftThatIsInStaysInWithoutAStep) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.take(kSkinTrocar, {0, 0, 0.010});
  hand.move({0, 0, -0.030}, 1000);
  hand.rest(300);
  ASSERT_EQ(session.tool_state().portal, 0u);
  hand.force_z.clear();
  hand.tick({CommandKind::kBareSkin, 0});
  hand.rest(200);
  EXPECT_EQ(session.tool_state().portal, 0u);
  for (std::size_t n = 1; n < hand.force_z.size(); ++n)
    ASSERT_LT(std::abs(hand.force_z[n] - hand.force_z[n - 1]), 0.05) << n;
}

TEST(BareSkin, ARestorePointFromBeforeThePortalHasTheSkinAgainUntilItIsMadeAnew) {
  Session session = skin_run().session();
  SkinHandAt hand(session);
  hand.tick();
  hand.tick({CommandKind::kMark, 0});
  go_through(hand, 0, 0);
  hand.tick({CommandKind::kBareSkin, 0});
  hand.tick({CommandKind::kMark, 1});
  EXPECT_EQ(pressed_by_ball(hand, 0.008, 0), 0);
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(100);
  EXPECT_GT(pressed_by_ball(hand, 0.008, 0), 1);
  go_through(hand, -0.004, 0.002);
  EXPECT_EQ(pressed_by_ball(hand, 0.008, 0), 0);
  hand.tick({CommandKind::kRestore, 1});
  hand.rest(100);
  EXPECT_EQ(pressed_by_ball(hand, 0.008, 0), 0);
  hand.take(kSkinScope, {0, 0, 0.010});
  hand.move({0, 0, -0.020}, 500);
  EXPECT_LT(session.tool_state().p_portal_W.norm(), 1e-4);
}

// One patch for a portal, and one beside it that is there for none.
const SkinRun& run_with_site() {
  static const SkinRun run(0, false, 0, {"skin:portal_al", "skin:aside"});
  return run;
}

TEST(BareSkin, SkinThatIsThereForNoPortalIsFeltUntilAllIsBare) {
  Session session = run_with_site().session();
  SkinHandAt hand(session);
  hand.tick();
  hand.tick({CommandKind::kBareSkin, 0});
  go_through(hand, 0, 0);
  EXPECT_EQ(pressed_by_ball(hand, 0.004, 0.003), 0);
  EXPECT_GT(pressed_by_ball(hand, 0.020, 0), 1);
  hand.tick({CommandKind::kMark, 0});
  hand.tick({CommandKind::kBareSkin, 1});
  EXPECT_EQ(pressed_by_ball(hand, 0.020, 0), 0);
  EXPECT_EQ(session.save().world.softs.skin->bares, SkinBare::kAll);
  const auto back = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(back->world.softs.skin->bares, SkinBare::kAll);
  // A restore point from before that has it again.
  hand.tick({CommandKind::kRestore, 0});
  hand.rest(100);
  EXPECT_GT(pressed_by_ball(hand, 0.020, 0), 1);
  EXPECT_EQ(pressed_by_ball(hand, 0.004, 0.003), 0);
}

TEST(BareSkin, AllIsBareWithoutAnyPortal) {
  Session session = run_with_site().session();
  SkinHandAt hand(session);
  hand.tick();
  EXPECT_GT(pressed_by_ball(hand, 0, 0), 1);
  hand.tick({CommandKind::kBareSkin, 1});
  EXPECT_EQ(pressed_by_ball(hand, 0, 0), 0);
  EXPECT_EQ(pressed_by_ball(hand, 0.020, 0), 0);
}

TEST(BareSkin, WithMoreThanOnePatchARecordingRepeats) {
  const auto& run = run_with_site();
  Session session = run.session();
  Recording recording = begin_recording(run);
  SkinHandAt hand(session);
  hand.into = &recording;
  hand.tick();
  go_through(hand, 0, 0);
  hand.tick({CommandKind::kBareSkin, 0});
  (void)pressed_by_ball(hand, 0.020, 0);
  hand.tick({CommandKind::kBareSkin, 1});
  (void)pressed_by_ball(hand, 0.020, 0);
  expect_same_replays(recording, run, session, {0.0, 1.9, 2.4});
}

TEST(BareSkin, ARecordingRepeatsFromTheStartAndTheMiddle) {
  const auto& run = skin_run();
  Session session = run.session();
  Recording recording = begin_recording(run);
  SkinHandAt hand(session);
  hand.into = &recording;
  hand.tick();
  go_through(hand, 0.002, 0);
  hand.tick({CommandKind::kBareSkin, 0});
  hand.take(kSkinScope, {0.003, 0, 0.010});
  hand.move({0.003, 0, -0.020}, 800);
  hand.move({0.020, 0.010, -0.018}, 400);
  ASSERT_EQ(session.tool_state().portal, 0u);
  expect_same_replays(recording, run, session, {0.0, 1.0, 2.1, 2.9});
  const auto back = state_from_bytes(to_bytes(session.save()));
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(back->world.softs.skin->bares, SkinBare::kPortals);
}

}  // namespace
}  // namespace osteon
