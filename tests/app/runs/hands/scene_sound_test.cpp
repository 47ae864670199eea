#include "runs/hands/scene_sound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/media/film_writer.h"
#include "osteon/scene/carve_events.h"
#include "runs/hands/instrument_voice.h"

namespace osteon {
namespace {

// The loudest sample of the next picture of 20 ms.
double next_picture(SceneSound& sound) {
  std::vector<float> samples(kSoundHz / 50);
  sound.render(samples);
  double most = 0;
  for (const float sample : samples) {
    EXPECT_TRUE(std::isfinite(sample));
    most = std::max(most, static_cast<double>(std::abs(sample)));
  }
  return most;
}

// A hand at rest in the air, at a picture's number.
ToolState resting(int picture) {
  ToolState tool;
  tool.tick = static_cast<std::uint64_t>(20 * picture + 1);
  tool.time_s = 0.001 * static_cast<double>(tool.tick);
  return tool;
}

struct HeardHand {
  HeardHand() { sound.begin({{}, {VoiceKind::kDrill, 0, 0, 900}}); }
  double show(const ToolState& tool) {
    sound.see({&tool, 1});
    return next_picture(sound);
  }
  SceneSound sound;
};

TEST(SceneSound, IsSilentWithoutHandsAndWhereNothingHappens) {
  SceneSound sound;
  sound.see({});
  EXPECT_EQ(next_picture(sound), 0);
  HeardHand heard;
  for (int k = 0; k < 10; ++k) EXPECT_EQ(heard.show(resting(k)), 0);
}

TEST(SceneSound, ADrillIsHeardWhileItHasPowerAndTheSceneGoesOn) {
  HeardHand heard;
  ToolState tool = resting(0);
  tool.instrument = 1;
  tool.power = 1;
  EXPECT_EQ(heard.show(tool), 0) << "one picture says nothing of what goes on";
  double most = 0;
  for (int k = 1; k < 25; ++k) {
    tool.tick += 20;
    tool.time_s += 0.020;
    most = heard.show(tool);
  }
  EXPECT_GT(most, 0.01);
  // A replay that is paused.
  for (int k = 0; k < 100; ++k) most = heard.show(tool);
  EXPECT_LT(most, 1e-3);
}

TEST(SceneSound, ATouchKnocksTheLouderTheFaster) {
  double knock[2];
  for (const bool fast : {false, true}) {
    HeardHand heard;
    EXPECT_EQ(heard.show(resting(0)), 0);
    ToolState tool = resting(1);
    tool.contact_count = 1;
    tool.v_W = Vec3(0, 0, fast ? -0.15 : -0.01);
    knock[fast] = heard.show(tool);
  }
  EXPECT_GT(knock[0], 0);
  EXPECT_GT(knock[1], 3 * knock[0]);
}

TEST(SceneSound, AJumpInTimeOrAnUndoKnocksOnNothing) {
  for (const bool undone : {false, true}) {
    HeardHand heard;
    (void)heard.show(resting(0));
    ToolState tool = resting(undone ? 1 : 300);
    tool.epoch = undone ? 1 : 0;
    tool.contact_count = 1;
    tool.instrument = 1;
    EXPECT_EQ(heard.show(tool), 0) << undone;
  }
}

TEST(SceneSound, EventsAreHeardAndNonsenseIsNot) {
  HeardHand heard;
  Event alarm;
  alarm.kind = EventKind::kForceOver;
  heard.sound.hear(alarm);
  EXPECT_GT(heard.show(resting(0)), 0.01);
  HeardHand other;
  Event mark;
  mark.kind = EventKind::kMark;
  other.sound.hear(mark);
  ToolState tool = resting(0);
  tool.instrument = 77;
  tool.power = std::numeric_limits<double>::quiet_NaN();
  tool.force_W = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 5; ++k) {
    tool.tick += 20;
    tool.time_s += 0.02;
    EXPECT_EQ(other.show(tool), 0);
  }
}

TEST(InstrumentVoice, AReamerThatChattersIsThrownBackUntilItRunsSmoothly) {
  HeardCut cut;
  Event event;
  event.kind = kChatter;
  event.values = {0.1, 35, 0};
  cut.hear(event);
  const VoiceDrive drive = driven({VoiceKind::kReamer, 0, 0, 350}, 1, 3, cut);
  EXPECT_DOUBLE_EQ(drive.judder, 0.5);
  EXPECT_EQ(drive.judder_hz, 35);
  event.kind = kChatterEnd;
  cut.hear(event);
  EXPECT_EQ(driven({VoiceKind::kReamer, 0, 0, 350}, 1, 3, cut).judder, 0);
}

// Metal in bone works harder than in air.
TEST(InstrumentVoice, BoneThatGoesLoadsAMotor) {
  const VoiceDrive voice{VoiceKind::kDrill, 0, 0, 900};
  EXPECT_EQ(driven(voice, 0.5, 0, {}).load, 0);
  EXPECT_GT(driven(voice, 0.5, 0, {.cutting = true}).load, 0);
  EXPECT_EQ(driven(voice, 0.5, 15, {.cutting = true}).load, 1);
  EXPECT_EQ(driven(voice, 0.5, 15, {.cutting = true}).power, 0.5);
  EXPECT_EQ(knock_strength(std::nan("")), knock_strength(0));
  EXPECT_EQ(knock_strength(9), 1);
}

}  // namespace
}  // namespace osteon
