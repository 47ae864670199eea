#include "runs/replays/replay_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runs/replays/replay_player.h"
#include "runs/reports/force_history.h"

namespace osteon {
namespace {

// Ten seconds along x at 10 mm/s; bone 2 is touched from 3 s to 4 s with 1.5 N.
ReplayTrack straight_run() {
  ReplayTrack track;
  BoneSnapshot bones;
  bones.count = 3;
  for (std::uint64_t tick = 1; tick <= 10000; ++tick) {
    ToolState tool;
    tool.tick = tick;
    tool.time_s = static_cast<double>(tick) * 0.001;
    tool.X_WP.p.x() = 0.01 * tool.time_s;
    if (tool.time_s >= 3 && tool.time_s < 4) {
      tool.contact_count = 1;
      tool.contacts[0].bone = BoneId{2};
      tool.force_W = Vec3(0, 0, 1.5);
    }
    if (tick == 5000) bones.bones[1].X_WB.p.y() = 0.02;
    track.add(tool, bones);
  }
  return track;
}

TEST(ReplayTrack, AnEmptyTrackShowsNothingAndHoldsNoForce) {
  const ReplayTrack track;
  EXPECT_TRUE(track.empty());
  EXPECT_EQ(track.at(1).bones.count, 0u);
  EXPECT_EQ(track.force_until(1, 4), std::vector<float>(4, 0.0f));
}

TEST(ReplayTrack, TheProbeMovesEvenlyAtAnySpeed) {
  const ReplayTrack track = straight_run();
  EXPECT_DOUBLE_EQ(track.duration_s(), 10);
  for (double t = 0.1; t < 9.9; t += 0.0137)
    EXPECT_NEAR(track.at(t).tool.X_WP.p.x(), 0.01 * t, 2e-5) << t;
}

TEST(ReplayTrack, TimesOutsideShowTheFirstAndTheLastPicture) {
  const ReplayTrack track = straight_run();
  EXPECT_NEAR(track.at(-5).tool.time_s, 0.001, 1e-9);
  EXPECT_NEAR(track.at(99).tool.X_WP.p.x(), 0.1, 2e-4);
}

TEST(ReplayTrack, BonesThatMoveAreSeenToMove) {
  const ReplayTrack track = straight_run();
  EXPECT_EQ(track.at(4.9).bones.bones[1].X_WB.p.y(), 0);
  EXPECT_NEAR(track.at(5.1).bones.bones[1].X_WB.p.y(), 0.02, 1e-12);
}

// A piece comes off after half a second, moves evenly for half a second and is gone after one.
ReplayTrack run_with_a_piece(std::uint64_t from, std::uint64_t to) {
  ReplayTrack track;
  for (std::uint64_t tick = from; tick < to; ++tick) {
    BoneSnapshot bones;
    ToolState tool;
    tool.tick = tick;
    tool.time_s = 0.001 * static_cast<double>(tick);
    if (tick >= 500 && tick < 1000) {
      bones.loose.count = 1;
      bones.loose.bones[0] = {42, 0, {Vec3(0.01 * (tool.time_s - 0.5), 0, 0), Quat::Identity()}};
    }
    track.add(tool, bones);
  }
  return track;
}

TEST(ReplayTrack, ALoosePieceIsSeenWhereItIsAndNoLonger) {
  ReplayTrack joined = run_with_a_piece(1, 700);
  joined.join(run_with_a_piece(700, 1400));
  for (const ReplayTrack& track : {run_with_a_piece(1, 1400), joined}) {
    EXPECT_EQ(track.at(0.4).bones.loose.count, 0u);
    for (double t = 0.53; t < 0.95; t += 0.0137) {
      ASSERT_EQ(track.at(t).bones.loose.count, 1u) << t;
      EXPECT_EQ(track.at(t).bones.loose.bones[0].shape, 42u);
      EXPECT_NEAR(track.at(t).bones.loose.bones[0].X_WB.p.x(), 0.01 * (t - 0.5), 2e-5) << t;
    }
    EXPECT_EQ(track.at(1.2).bones.loose.count, 0u);
  }
}

TEST(ReplayTrack, WaterAndPinsAreSeenAsTheyWere) {
  ReplayTrack track, later;
  BoneSnapshot bones;
  bones.count = 1;
  bones.water.on = true;
  for (std::uint64_t tick = 1; tick <= 4000; ++tick) {
    ToolState tool;
    tool.tick = tick;
    tool.time_s = static_cast<double>(tick) * 0.001;
    bones.water.blood = 0.001 * tool.time_s;
    if (tick == 2000) bones.rods[0].kind = GuideRod::Kind::kPin;
    (tick <= 3000 ? track : later).add(tool, bones);
  }
  track.join(later);
  for (double t = 0.1; t < 4; t += 0.13)
    EXPECT_NEAR(track.at(t).bones.water.blood, 0.001 * t, 0.00023) << t;
  EXPECT_EQ(track.at(1.9).bones.rods[0].kind, GuideRod::Kind::kNone);
  EXPECT_EQ(track.at(2.3).bones.rods[0].kind, GuideRod::Kind::kPin);
  EXPECT_EQ(track.at(3.5).bones.rods[0].kind, GuideRod::Kind::kPin);
}

TEST(ReplayTrack, TouchesAndForceAreWhereTheyWere) {
  const ReplayTrack track = straight_run();
  ASSERT_EQ(track.contacts().spans().size(), 1u);
  const ContactSpan& span = track.contacts().spans()[0];
  EXPECT_EQ(span.bone, BoneId{2});
  EXPECT_NEAR(span.start_s, 3, 0.005);
  EXPECT_NEAR(span.end_s, 4, 0.005);
  EXPECT_FLOAT_EQ(span.peak_force_n, 1.5f);
  const auto force = track.force_until(4.5, static_cast<std::size_t>(2 * kForceHistoryHz));
  EXPECT_EQ(force.front(), 0);                                        // 2.5 s
  EXPECT_EQ(force[static_cast<std::size_t>(kForceHistoryHz)], 1.5f);  // 3.5 s
  EXPECT_EQ(force.back(), 0);                                         // 4.5 s
}

TEST(ReplayPlayer, PlaysAtItsSpeedAndStopsAtTheEnd) {
  ReplayPlayer player(10);
  player.set_speed(0.5);
  player.advance(4);
  EXPECT_DOUBLE_EQ(player.position_s(), 2);
  player.set_speed(100);
  EXPECT_DOUBLE_EQ(player.speed(), ReplayPlayer::kFastest);
  player.advance(50);
  EXPECT_DOUBLE_EQ(player.position_s(), 10);
  EXPECT_FALSE(player.playing());
  player.toggle();
  EXPECT_DOUBLE_EQ(player.position_s(), 0);
  EXPECT_TRUE(player.playing());
}

TEST(ReplayPlayer, APausedReplayStandsAndSeekStaysInside) {
  ReplayPlayer player(10);
  player.toggle();
  player.advance(3);
  EXPECT_DOUBLE_EQ(player.position_s(), 0);
  player.seek(-4);
  EXPECT_DOUBLE_EQ(player.position_s(), 0);
  player.seek(40);
  EXPECT_DOUBLE_EQ(player.position_s(), 10);
}

}  // namespace
}  // namespace osteon
