// Recordings of a few ticks, written by hand, and what they sound like.
#include "runs/replays/recorded_sound.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "osteon/media/film_writer.h"
#include "osteon/scene/carve_events.h"
#include "osteon/session/session.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSoundTicks = 1000;

class RecordedSoundTest : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }

  /// One second of one hand that holds a drill, with these events and this force.
  void record(std::vector<Event> events, double force_n = 0) {
    SessionSettings settings;
    settings.tray = {"drill:4.2", "hook_probe"};
    RecordingHeader header;
    header.case_name = header.case_source = "none";
    header.settings_json = to_json(settings);
    fs::remove(file_);
    auto writer = RecordingWriter::create(file_, header);
    ASSERT_TRUE(writer) << writer.error().message();
    ASSERT_TRUE(writer->add(StepRecord{1, {}, {}}));
    for (std::uint64_t tick = 1; tick <= kSoundTicks; ++tick) {
      TickRecord record;
      record.tick = tick;
      record.bone_step = 1;
      record.force_W = Vec3(0, force_n, 0);
      record.input.v_W = Vec3(0.1, 0, 0);
      ASSERT_TRUE(writer->add(record));
    }
    for (const Event& event : events) ASSERT_TRUE(writer->add(event));
    ASSERT_TRUE(writer->finish());
  }

  std::vector<float> heard(double from_s = 0, double for_s = 1) {
    auto recording = RecordingReader::open(file_);
    if (!recording) throw std::runtime_error(recording.error().message());
    auto sound = RecordedSound::create(*recording, from_s);
    if (!sound) throw std::runtime_error(sound.error().message());
    std::vector<float> out(static_cast<std::size_t>(for_s * kSoundHz));
    if (auto ok = sound->render(out); !ok) throw std::runtime_error(ok.error().message());
    return out;
  }

  const fs::path file_ =
      fs::temp_directory_path() / ("osteon_sound_" + std::to_string(::getpid()) + ".osr");
};

Event event_at(std::uint64_t tick, EventKind kind, double value = 0, std::uint32_t subject = 0) {
  Event event;
  event.tick = tick;
  event.kind = kind;
  event.hand = 0;
  event.subject = subject;
  event.values[0] = value;
  return event;
}

bool silent(const std::vector<float>& sound, double from_s, double to_s) {
  const auto at = [&](double s) { return sound.begin() + static_cast<long>(s * kSoundHz); };
  return std::all_of(at(from_s), at(to_s), [](float s) { return s == 0; });
}

double level_of(const std::vector<float>& sound, double hz) {
  double re = 0, im = 0;
  for (std::size_t k = 0; k < sound.size(); ++k) {
    const double turn = 6.283185307179586 * hz * static_cast<double>(k) / kSoundHz;
    re += static_cast<double>(sound[k]) * std::cos(turn);
    im += static_cast<double>(sound[k]) * std::sin(turn);
  }
  return 2 * std::hypot(re, im) / static_cast<double>(sound.size());
}

TEST_F(RecordedSoundTest, WhereNothingHappensIsSilence) {
  record({}, 3);
  EXPECT_TRUE(silent(heard(), 0, 1));
}

TEST_F(RecordedSoundTest, AContactIsHeardWhenItBegins) {
  record({event_at(500, EventKind::kContactBegin, 0.2)});
  const auto sound = heard();
  // Tick 500 begins 499 ms after the begin.
  EXPECT_TRUE(silent(sound, 0, 0.499));
  EXPECT_FALSE(silent(sound, 0.499, 0.51));
  EXPECT_TRUE(silent(sound, 0.7, 1));
}

TEST_F(RecordedSoundTest, ADrillTurnsWhileItHasPowerAndOnlyThen) {
  record({event_at(201, EventKind::kPowered, 1), event_at(501, EventKind::kPowered, 0)});
  const auto sound = heard(0, 2);
  EXPECT_TRUE(silent(sound, 0, 0.2));
  EXPECT_FALSE(silent(sound, 0.21, 0.5));
  EXPECT_TRUE(silent(sound, 1.7, 2));
}

// 1200 turns a minute through a gear of 18: 360 Hz; a hand that presses slows it down.
TEST_F(RecordedSoundTest, ADrillsToneIsItsOwnAndSagsUnderTheHandsForce) {
  record({event_at(1, EventKind::kPowered, 1)});
  const auto free = heard(0.5, 0.5);
  EXPECT_GT(level_of(free, 360), 0.05);
  record({event_at(1, EventKind::kPowered, 1)}, 15);
  const auto pressed = heard(0.5, 0.5);
  EXPECT_LT(level_of(pressed, 360), 0.2 * level_of(free, 360));
  EXPECT_GT(level_of(pressed, 0.82 * 360), 0.05);
}

TEST_F(RecordedSoundTest, AnotherInstrumentComesWithItsClickAndWithoutPower) {
  record({event_at(1, EventKind::kPowered, 1), event_at(301, EventKind::kInstrumentTaken, 0, 1)});
  const auto sound = heard(0, 2);
  EXPECT_FALSE(silent(sound, 0.301, 0.31));
  EXPECT_TRUE(silent(sound, 1.7, 2));
}

TEST_F(RecordedSoundTest, GoingBackToAMarkBringsItsPowerBack) {
  record({event_at(10, EventKind::kPowered, 1), event_at(20, EventKind::kMark, 0, 3),
          event_at(30, EventKind::kPowered, 0), event_at(900, EventKind::kRestored, 0, 3)});
  const auto sound = heard(0.8, 0.2);
  EXPECT_FALSE(silent(sound, 0.1, 0.2));
}

TEST_F(RecordedSoundTest, APartBeginsWithWhatHasPowerThen) {
  record({event_at(1, EventKind::kPowered, 1), event_at(2, EventKind::kForceOver, 9)});
  const auto part = heard(0.5, 0.4);
  EXPECT_FALSE(silent(part, 0, 0.4));
  // The alarm was before.
  EXPECT_LT(level_of(part, 880), 0.01);
}

TEST_F(RecordedSoundTest, TheSameRecordingGivesTheSameSamples) {
  record({event_at(1, EventKind::kPowered, 1), event_at(300, kCutBegin, 4.2),
          event_at(600, kBreached, 10), event_at(610, kCutEnd)},
         8);
  EXPECT_EQ(heard(), heard());
}

}  // namespace
}  // namespace osteon
