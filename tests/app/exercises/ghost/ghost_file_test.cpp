#include "exercises/ghost/ghost_file.h"

#include <gtest/gtest.h>

#include <limits>

namespace osteon {
namespace {

GhostTrack some_track() {
  GhostTrack track;
  track.tray = {"hook_probe", ""};
  for (int hand = 0; hand < 2; ++hand) {
    auto& samples = track.hands.emplace_back();
    for (int i = 0; i < 5; ++i) {
      GhostTrack::Sample sample;
      sample.X_WT.p = Vec3(0.1 * i, -1.0 / 3, hand);
      sample.X_WT.q = Quat(0.5, 0.5, -0.5, 0.5);
      sample.instrument = static_cast<std::uint32_t>(hand);
      samples.push_back(sample);
    }
  }
  track.hands[1][4].X_WT.p.x() =
      std::numeric_limits<double>::quiet_NaN();  // as a broken tool tells
  track.stretches = {{0, {{0, 0}, {0, 2}}, 0, 3}, {1, {}, 3, 4}};
  return track;
}

TEST(GhostFile, WhatIsReadIsWhatWasWritten) {
  const GhostTrack track = some_track();
  const std::string bytes = to_bytes(track, 7);
  const auto read = ghost_from_bytes(bytes, 7);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(to_bytes(*read, 7), bytes);
  EXPECT_EQ(read->tray, track.tray);
  ASSERT_EQ(read->hands.size(), 2u);
  EXPECT_EQ(read->hands[0][3].X_WT.p, track.hands[0][3].X_WT.p);
  EXPECT_EQ(read->hands[1][2].instrument, 1u);
  ASSERT_EQ(read->stretches.size(), 2u);
  EXPECT_EQ(read->stretches[0].done, track.stretches[0].done);
  EXPECT_EQ(read->stretches[1].to, 4u);
  EXPECT_TRUE(ghost_from_bytes(to_bytes(GhostTrack{}, 7), 7));
}

TEST(GhostFile, WhatIsDamagedOrOfAnotherBuildIsRefused) {
  const std::string bytes = to_bytes(some_track(), 7);
  EXPECT_FALSE(ghost_from_bytes(bytes, 8));
  EXPECT_FALSE(ghost_from_bytes("", 7));
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    EXPECT_FALSE(ghost_from_bytes(std::string_view(bytes).substr(0, n), 7)) << n;
    std::string other = bytes;
    other[n] = static_cast<char>(other[n] ^ 0x41);
    EXPECT_FALSE(ghost_from_bytes(other, 7)) << n;
  }
  GhostTrack beyond = some_track();
  beyond.stretches[1].to = 5;
  EXPECT_FALSE(ghost_from_bytes(to_bytes(beyond, 7), 7)) << "a stretch past the end";
  GhostTrack uneven = some_track();
  uneven.hands[0].pop_back();
  EXPECT_FALSE(ghost_from_bytes(to_bytes(uneven, 7), 7));
}

TEST(GhostFile, AFileThatIsNotThereHasNoKey) {
  EXPECT_EQ(ghost_key("/nowhere/at/all.osr"), 0u);
  EXPECT_NE(ghost_key("/proc/self/exe"), 0u);
}

}  // namespace
}  // namespace osteon
