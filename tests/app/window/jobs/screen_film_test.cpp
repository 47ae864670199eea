// Films of a window that is drawn at odd times, read back by FFmpeg's libraries.
#include "window/jobs/screen_film.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "media/read_film.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

Image grey(int width, int height, std::uint8_t level) {
  Image image{width, height, {}};
  image.rgb.assign(3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), level);
  return image;
}

class ScreenFilms : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::temp_directory_path() / ("osteon-screen-" + std::to_string(::getpid()) + ".webm");
  }
  void TearDown() override { fs::remove(file_); }
  std::unique_ptr<ScreenFilm> begin() {
    auto film = ScreenFilm::begin(file_, 64, 48);
    if (film) return std::move(*film);
    why_not_ = film.error().message();
    return nullptr;
  }
  fs::path file_;
  std::string why_not_;
};

TEST(CentredPicture, IsCutOrHasBlackAroundIt) {
  const Image large = centred(grey(10, 8, 200), 4, 2);
  EXPECT_EQ(large.rgb, grey(4, 2, 200).rgb);
  const Image small = centred(grey(2, 2, 200), 6, 4);
  int lit = 0;
  for (const std::uint8_t v : small.rgb) lit += v == 200 ? 1 : 0;
  EXPECT_EQ(lit, 3 * 4);
  EXPECT_EQ(small.rgb[0], 0);
  EXPECT_EQ(small.rgb[3u * (1 * 6 + 2)], 200);
  EXPECT_TRUE(centred(grey(0, 0, 0), 2, 2).rgb.size() == 12u);
}

TEST_F(ScreenFilms, KeepTheirTimeWherePicturesComeLate) {
  const auto film = begin();
  if (!film) GTEST_SKIP() << why_not_;
  EXPECT_TRUE(film->due(0));
  film->add(0, grey(64, 48, 20));
  EXPECT_FALSE(film->due(0.01)) << "one a twenty-fifth of a second";
  film->add(0.01, grey(64, 48, 90));  // is not due, and left out
  film->add(0.41, grey(64, 48, 220));
  film->add(0.45, grey(32, 24, 220));  // the window was made smaller
  film->end(0.6);
  ASSERT_TRUE(film->wait()) << film->result().error().message();
  EXPECT_TRUE(film->done());
  EXPECT_FALSE(film->due(1));
  EXPECT_GT(film->bytes(), 100u);
  const ReadFilm read = read_film(file_.string());
  ASSERT_EQ(read.pictures.size(), 15u);
  const auto middle = [&](std::size_t k) { return read.pictures[k][24 * 64 + 32]; };
  EXPECT_LT(middle(9), 60);
  EXPECT_GT(middle(10), 150);
  EXPECT_GT(middle(14), 150);
  EXPECT_LT(read.pictures[14][0], 60) << "black around a smaller window";
}

// A tone from the second picture on; the sound of the last ones is missing.
TEST_F(ScreenFilms, HaveTheSoundThatTheyWereTold) {
  auto film = ScreenFilm::begin(file_, 64, 48);
  if (!film) GTEST_SKIP() << film.error().message();
  std::vector<float> silence(kSoundHz / 2), tone(kSoundHz / 2);
  for (std::size_t k = 0; k < tone.size(); ++k)
    tone[k] = 0.5f * static_cast<float>(
                         std::sin(2 * std::numbers::pi * 1000 * static_cast<double>(k) / kSoundHz));
  (*film)->hear(silence);
  (*film)->hear(tone);
  Image grey{64, 48, std::vector<std::uint8_t>(64 * 48 * 3, 90)};
  (*film)->add(0, grey);
  (*film)->end(1.5);
  ASSERT_TRUE((*film)->wait());
  film->reset();
  const ReadFilm read = read_film(file_.string());
  EXPECT_EQ(read.sound_hz, 48000);
  ASSERT_GT(read.sound.size(), 1.4 * kSoundHz);
  const auto part = [&](double from_s, double to_s) {
    return std::vector<float>(read.sound.begin() + static_cast<long>(from_s * kSoundHz),
                              read.sound.begin() + static_cast<long>(to_s * kSoundHz));
  };
  EXPECT_LT(level_at(part(0.1, 0.4), 1000, kSoundHz), 0.02);
  EXPECT_NEAR(level_at(part(0.6, 0.9), 1000, kSoundHz), 0.5, 0.1);
  EXPECT_LT(level_at(part(1.1, 1.4), 1000, kSoundHz), 0.02);
}

TEST_F(ScreenFilms, AreWholeWhenTheWindowCloses) {
  {
    const auto film = begin();
    if (!film) GTEST_SKIP() << why_not_;
    film->add(0, grey(64, 48, 20));
  }
  EXPECT_EQ(read_film(file_.string()).pictures.size(), 1u);
}

TEST_F(ScreenFilms, AFullDiskIsToldAndAnUnwritablePlaceRefused) {
  EXPECT_FALSE(ScreenFilm::begin("/nowhere/at/all/film.webm", 64, 48));
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  auto film = ScreenFilm::begin("/dev/full", 64, 48);
  if (!film) return;  // told at once
  (*film)->add(0, grey(64, 48, 20));
  (*film)->end(0.1);
  EXPECT_FALSE((*film)->wait());
}

}  // namespace
}  // namespace osteon
