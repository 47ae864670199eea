// Loose rings in a session: felt by nobody, saved, hashed and repeated with everything else.
#include <gtest/gtest.h>

#include "count_allocations.h"
#include "osteon/session/session.h"
#include "recorded_run.h"
#include "ring_box.h"

namespace osteon {
namespace {

using testing::jaws_at_ring;
using testing::keep_tick;
using testing::kRingLies_m;
using testing::ring_box;

// Grasps the first ring, lifts it, carries it over the second peg and lets it go.
HandInput ring_hand(std::uint64_t n) {
  const double t = static_cast<double>(n) * 0.001;
  const auto part = [t](double from, double to) {
    return std::min(1.0, std::max(0.0, (t - from) / (to - from)));
  };
  const Vec3 center(0.03 * part(0.6, 1.2), 0, kRingLies_m + 0.014 * part(0.2, 0.5));
  HandInput hand;
  hand.input.X_WD = jaws_at_ring(center, 0).X_WP;
  if (n == 50) hand.command = {CommandKind::kJaw, 1};
  if (n == 100) hand.command = {CommandKind::kJaw, 0};
  if (n == 800) hand.command = {CommandKind::kMark, 2};
  if (n == 1300) hand.command = {CommandKind::kJaw, 1};
  return hand;
}

void run_rings(Session& session, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t n = from; n <= to; ++n) {
    const HandInput hand = ring_hand(n);
    (void)session.tick(std::span(&hand, 1));
  }
}

Vec3 ring_at(const Session& session) { return session.bones().bones[5].X_WB.p; }

TEST(SessionRings, AreCarriedFeltByNobodyAndLandOnTheOtherPeg) {
  Session session(ring_box(), {});
  run_rings(session, 1, 300);
  EXPECT_EQ(session.tool_state().force_W, Vec3(Vec3::Zero()));
  run_rings(session, 301, 1250);
  EXPECT_NEAR((ring_at(session) - Vec3(0.03, 0, kRingLies_m + 0.014)).norm(), 0, 2e-4);
  const std::size_t before = testing::allocations();
  run_rings(session, 1251, 1500);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_NEAR((ring_at(session) - Vec3(0.03, 0, kRingLies_m)).norm(), 0, 2e-4);
  EXPECT_EQ(session.bones().bones[6].X_WB.p, ring_box()->bones[6].X_WB.p);
}

TEST(SessionRings, AStateInTheMiddleGoesOnWithTheSameBits) {
  for (const std::uint64_t stop : {60u, 700u, 1310u, 1450u}) {
    Session session(ring_box(), {});
    run_rings(session, 1, stop);
    const SessionState state = session.save();
    const std::uint64_t hash = session.state_hash();
    run_rings(session, stop + 1, 1500);
    Session other(ring_box(), {});
    const auto read = state_from_bytes(to_bytes(state));
    ASSERT_TRUE(read) << read.error().message();
    ASSERT_TRUE(other.restore(*read));
    EXPECT_EQ(other.state_hash(), hash) << stop;
    run_rings(other, stop + 1, 1500);
    EXPECT_EQ(other.state_hash(), session.state_hash()) << stop;
    SessionState odd = state;
    odd.world.rings.count = 1;
    EXPECT_FALSE(other.restore(odd));
  }
}

TEST(SessionRings, ARecordingRepeatsAndARestorePointLetsTheRingFall) {
  const auto box = ring_box();
  const SessionSettings settings;
  Session session(box, settings);
  Recording recording;
  recording.header = recording_header(*box, settings, "test", "0");
  for (std::uint64_t n = 1; n <= 1500; ++n) {
    HandInput hand = ring_hand(n);
    if (n == 1000) hand.command = {CommandKind::kRestore, 2};  // it was in the air then
    (void)session.tick(std::span(&hand, 1));
    keep_tick(recording, session);
  }
  recording.complete = true;
  const auto again = replay(recording, box);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_TRUE(again->identical);
  EXPECT_EQ(again->state_hash, session.state_hash());
  EXPECT_LT(ring_at(session).z(), 0.0015);
  EXPECT_LT(ring_at(session).x(), 0.02);
}

}  // namespace
}  // namespace osteon
