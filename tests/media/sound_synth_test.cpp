#include "osteon/media/sound_synth.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "osteon/media/film_writer.h"
#include "osteon/media/wav_writer.h"
#include "read_film.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

std::vector<float> played(SoundSynth& synth, double for_s) {
  std::vector<float> out(static_cast<std::size_t>(for_s * kSoundHz));
  synth.render(out);
  return out;
}

double loudness(const std::vector<float>& sound) {
  double sum = 0;
  for (const float s : sound) sum += static_cast<double>(s) * static_cast<double>(s);
  return std::sqrt(sum / static_cast<double>(sound.size()));
}

bool is_silent(const std::vector<float>& sound) {
  return std::all_of(sound.begin(), sound.end(), [](float s) { return s == 0; });
}

double loudest_hz(const std::vector<float>& sound, double from_hz, double to_hz, double step_hz) {
  double best_hz = 0, best = 0;
  for (double hz = from_hz; hz < to_hz; hz += step_hz)
    if (const double level = level_at(sound, hz, kSoundHz); level > best) {
      best = level;
      best_hz = hz;
    }
  return best_hz;
}

constexpr VoiceKind kAllVoices[] = {VoiceKind::kDrill,  VoiceKind::kReamer,  VoiceKind::kBurr,
                                    VoiceKind::kShaver, VoiceKind::kSuction, VoiceKind::kCautery};

TEST(SoundSynth, NothingSoundsWithoutPowerOrEvent) {
  SoundSynth synth;
  EXPECT_TRUE(is_silent(played(synth, 0.5)));
  for (const VoiceKind kind : kAllVoices) {
    synth.drive(0, {kind, 0, 1, 1200});
    EXPECT_TRUE(is_silent(played(synth, 0.1)));
  }
  synth.drive(99, {VoiceKind::kDrill, 1, 0, 1200});
  synth.cue(CueKind::kKnock, 0);
  EXPECT_TRUE(is_silent(played(synth, 0.1)));
}

TEST(SoundSynth, NumbersThatAreNoneAreSilence) {
  SoundSynth synth;
  synth.drive(0, {VoiceKind::kDrill, std::nan(""), std::nan(""), 1200});
  synth.cue(CueKind::kBeep, std::nan(""));
  EXPECT_TRUE(is_silent(played(synth, 0.1)));
  synth.drive(0, {VoiceKind::kDrill, 1, 0, std::numeric_limits<double>::infinity()});
  for (const float s : played(synth, 0.1)) EXPECT_TRUE(std::isfinite(s));
}

TEST(SoundSynth, EveryVoiceSoundsWithinItsRangeAndEndsInSilence) {
  for (const VoiceKind kind : kAllVoices) {
    SoundSynth synth;
    synth.drive(0, {kind, 1, 0.5, 1200});
    const auto loud = played(synth, 0.5);
    EXPECT_GT(loudness(loud), 0.01) << static_cast<int>(kind);
    for (const float s : loud) ASSERT_LE(std::abs(s), 1.0f);
    synth.drive(0, {});
    played(synth, 1.5);
    EXPECT_TRUE(is_silent(played(synth, 0.1))) << static_cast<int>(kind);
  }
}

TEST(SoundSynth, EveryCueIsHeardAndEnds) {
  for (const CueKind kind : {CueKind::kBeep, CueKind::kExchange, CueKind::kAlarm, CueKind::kFault,
                             CueKind::kKnock, CueKind::kThrough}) {
    SoundSynth synth;
    synth.cue(kind);
    EXPECT_GT(loudness(played(synth, 0.1)), 0.005) << static_cast<int>(kind);
    played(synth, 1);
    EXPECT_TRUE(is_silent(played(synth, 0.1))) << static_cast<int>(kind);
  }
}

// The frequencies come from a sweep by Fourier sums of the samples, not from the synthesiser.
TEST(SoundSynth, AFreeDrillsFundamentalIsItsMotors) {
  for (const double power : {1.0, 0.5}) {
    SoundSynth synth;
    synth.drive(0, {VoiceKind::kDrill, power, 0, 1200});
    played(synth, 0.8);
    const auto sound = played(synth, 1);
    const std::vector<float> some(sound.begin(), sound.begin() + kSoundHz / 5);
    const double about_hz = loudest_hz(some, 60, 1000, 5);
    const double best_hz = loudest_hz(sound, about_hz - 6, about_hz + 6, 0.5);
    const double best = level_at(sound, best_hz, kSoundHz);
    // 1200 turns a minute through a gear of 18.
    EXPECT_NEAR(best_hz, 360 * power, 1.01);
    EXPECT_DOUBLE_EQ(voice_hz(VoiceKind::kDrill, 1200, power), 360 * power);
    EXPECT_LT(level_at(sound, best_hz / 2, kSoundHz), 0.05 * best);
  }
}

TEST(SoundSynth, UnderLoadADrillIsSlowerAndLouderAndRougher) {
  const auto settled = [](double load) {
    SoundSynth synth;
    synth.drive(0, {VoiceKind::kDrill, 1, load, 1200});
    played(synth, 0.8);
    return played(synth, 1);
  };
  const auto free = settled(0), loaded = settled(1);
  EXPECT_GT(loudness(loaded), 1.2 * loudness(free));
  // 18 percent slower.
  EXPECT_GT(level_at(loaded, 0.82 * 360, kSoundHz), 5 * level_at(loaded, 360, kSoundHz));
  // Between the partials: noise of what is cut.
  double between_free = 0, between_loaded = 0;
  for (double hz = 3300; hz < 3340; hz += 4) {
    between_free += level_at(free, hz, kSoundHz);
    between_loaded += level_at(loaded, hz, kSoundHz);
  }
  EXPECT_GT(between_loaded, 1.5 * between_free);
}

// A reamer that chatters grows louder and softer with each tooth.
TEST(SoundSynth, ChatterIsHeardAtItsFrequency) {
  const auto loudness_at = [](double judder, double hz) {
    SoundSynth synth;
    VoiceDrive drive{VoiceKind::kReamer, 1, 0.5, 350};
    drive.judder = judder;
    drive.judder_hz = 35;
    synth.drive(0, drive);
    (void)played(synth, 0.5);
    std::vector<float> power = played(synth, 2);
    double mean = 0;
    for (float& s : power) s *= s, mean += static_cast<double>(s);
    mean /= static_cast<double>(power.size());
    return level_at(power, hz, kSoundHz) / mean;
  };
  EXPECT_GT(loudness_at(1, 35), 4 * loudness_at(0, 35));
  EXPECT_GT(loudness_at(1, 35), 4 * loudness_at(1, 21));
}

TEST(SoundSynth, TheFluoroscopeBeepsAtOneKilohertz) {
  SoundSynth synth;
  synth.cue(CueKind::kBeep);
  const auto sound = played(synth, 0.1);
  EXPECT_GT(level_at(sound, 1000, kSoundHz), 0.1);
  EXPECT_LT(level_at(sound, 1500, kSoundHz), 0.01);
}

TEST(SoundSynth, TheSameCallsGiveTheSameSamplesHoweverTheyAreCut) {
  const auto play = [](std::size_t block) {
    SoundSynth synth(7);
    synth.drive(0, {VoiceKind::kShaver, 1, 0.7, 6000});
    synth.drive(1, {VoiceKind::kSuction, 0.6, 0.2, 0});
    synth.cue(CueKind::kExchange);
    std::vector<float> out(9600);
    for (std::size_t at = 0; at < out.size(); at += block)
      synth.render({out.data() + at, std::min(block, out.size() - at)});
    return out;
  };
  EXPECT_EQ(play(9600), play(48));
  EXPECT_EQ(play(9600), play(7));
}

class WavTest : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }
  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
  const fs::path file_ =
      fs::temp_directory_path() / ("osteon_wav_" + std::to_string(::getpid()) + ".wav");
};

TEST_F(WavTest, HeaderAndSamplesAreThoseOfTheFormat) {
  auto wav = WavWriter::create(file_, 5);
  ASSERT_TRUE(wav);
  ASSERT_TRUE(wav->add(std::vector<float>{0, 0.5f, -1, 2}));
  EXPECT_FALSE(fs::exists(file_));
  ASSERT_TRUE(wav->finish());
  const std::string all = bytes();
  ASSERT_EQ(all.size(), 44u + 10u);
  EXPECT_EQ(all.substr(0, 4), "RIFF");
  EXPECT_EQ(all.substr(8, 8), "WAVEfmt ");
  std::uint32_t rate = 0;
  std::memcpy(&rate, all.data() + 24, 4);
  EXPECT_EQ(rate, 48000u);
  std::int16_t samples[5];
  std::memcpy(samples, all.data() + 44, 10);
  EXPECT_EQ(samples[0], 0);
  EXPECT_EQ(samples[1], 16384);
  EXPECT_EQ(samples[2], -32767);
  EXPECT_EQ(samples[3], 32767);
  EXPECT_EQ(samples[4], 0);
  const ReadFilm read = read_film(file_.string());
  EXPECT_EQ(read.format, "wav");
  EXPECT_EQ(read.sound_hz, 48000);
}

TEST_F(WavTest, GivenUpOrTooLongItLeavesNothing) {
  {
    auto wav = WavWriter::create(file_, 5);
    ASSERT_TRUE(wav);
  }
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_FALSE(WavWriter::create(file_, 1ull << 33));
  EXPECT_FALSE(WavWriter::create("/no/such/folder/a.wav", 5));
}

}  // namespace
}  // namespace osteon
