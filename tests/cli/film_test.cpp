// osteon film and osteon sound as a user runs them, read back by FFmpeg's libraries.
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "../media/read_film.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

/// One run of an exercise with a scope alone, shared by all tests.
const std::string& scope_recording() {
  static const std::string file = [] {
    const fs::path to =
        fs::temp_directory_path() / ("osteon_film_" + std::to_string(::getpid()) + ".osr");
    fs::remove(to);
    std::atexit([] {
      fs::remove(fs::temp_directory_path() /
                 ("osteon_film_" + std::to_string(::getpid()) + ".osr"));
    });
    const Ran ran = run_osteon("run fast_periscoping --no-store --record " + to.string());
    if (ran.exit_code != 0) ADD_FAILURE() << ran.output;
    return to.string();
  }();
  return file;
}

bool no_opengl(const Ran& ran) {
  return ran.exit_code != 0 && ran.output.find("EGL") != std::string::npos;
}

/// Mean difference of two pictures, in steps of 0 to 255.
double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
  return sum / static_cast<double>(a.size());
}

class FilmCli : public CliTest {
 protected:
  Ran film(const std::string& arguments) {
    return run_osteon("film " + scope_recording() + " " + arguments);
  }
  std::string bytes(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  }
};

TEST_F(FilmCli, AScopesSecondHasItsPicturesAndSound) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "takes long: set OSTEON_LONG=1";
  const Ran ran = film("--view scope --size 80x60 --fps 4 --from 6 --to 7 --out " + file("a.webm") +
                       " --sound " + file("a.wav"));
  if (no_opengl(ran)) GTEST_SKIP() << ran.output;
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const ReadFilm read = read_film(file("a.webm"));
  EXPECT_EQ(read.picture_codec, "vp9");
  EXPECT_EQ(read.sound_codec, "opus");
  EXPECT_EQ(read.width, 80);
  EXPECT_EQ(read.height, 60);
  EXPECT_NEAR(read.duration_s, 1, 0.05);
  ASSERT_EQ(read.pictures.size(), 4u);
  // The scope moves, and its picture is round: dark in the corners, lit in the middle.
  EXPECT_GT(difference(read.pictures.front(), read.pictures.back()), 1);
  EXPECT_LT(read.pictures[2][0], 24);
  EXPECT_GT(read.pictures[2][30 * 80 + 40], 40);
  EXPECT_EQ(fs::file_size(file("a.wav")), 44u + 2 * 48000);
  EXPECT_EQ(read_film(file("a.wav")).sound_hz, 48000);
}

TEST_F(FilmCli, TheLayoutShowsAllViewsAtOnce) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "takes long: set OSTEON_LONG=1";
  const Ran ran =
      film("--view layout --size 192x96 --fps 2 --from 1 --to 2 --mute --out " + file("a.webm"));
  if (no_opengl(ran)) GTEST_SKIP() << ran.output;
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const ReadFilm read = read_film(file("a.webm"));
  EXPECT_TRUE(read.sound_codec.empty());
  ASSERT_EQ(read.pictures.size(), 2u);
  const auto spread = [&](int left, int top, int wide, int high) {
    int low = 255, most = 0;
    for (int y = top; y < top + high; ++y)
      for (int x = left; x < left + wide; ++x) {
        const int v = read.pictures[1][static_cast<std::size_t>(y * 192 + x)];
        low = std::min(low, v);
        most = std::max(most, v);
      }
    return most - low;
  };
  EXPECT_GT(spread(20, 10, 80, 70), 60) << "scope";
  EXPECT_GT(spread(130, 2, 60, 26), 30) << "panorama";
  EXPECT_GT(spread(130, 34, 60, 26), 30) << "outside";
  EXPECT_GT(spread(145, 66, 30, 28), 30) << "fluoroscope";
}

TEST_F(FilmCli, ARecordingsSoundIsTheSameBytesTwiceAndNeedsNoCase) {
  const std::string line = "sound " + scope_recording() + " --from 1 --to 4 --out ";
  ASSERT_EQ(run_osteon(line + file("a.wav")).exit_code, 0);
  ASSERT_EQ(run_osteon(line + file("b.wav")).exit_code, 0);
  EXPECT_EQ(bytes("a.wav").size(), 44u + 3 * 2 * 48000);
  EXPECT_EQ(bytes("a.wav"), bytes("b.wav"));
}

TEST_F(FilmCli, WhatCannotBeMadeIsSaidAndLeavesNothing) {
  const std::string out = " --out " + file("a.webm");
  for (const char* wrong : {"--view sideways", "--from 9999", "--from 3 --to 2", "--fps 0",
                            "--size big", "--view panorama --side under"}) {
    const Ran ran = film(wrong + out);
    EXPECT_EQ(ran.exit_code, 2) << wrong << ": " << ran.output;
    EXPECT_FALSE(ran.output.empty()) << wrong;
  }
  EXPECT_EQ(film("--out " + file("a.mp4")).exit_code, 2);
  const Ran still = film("--from 1 --to 2 --out " + file("a.png"));
  EXPECT_EQ(still.exit_code, 2);
  EXPECT_NE(still.output.find("one picture, of the time --from"), std::string::npos);
  EXPECT_EQ(run_osteon("film /no/such.osr" + out).exit_code, 2);
  EXPECT_EQ(run_osteon("sound /no/such.osr --out " + file("a.wav")).exit_code, 2);
  EXPECT_TRUE(fs::is_empty(dir_));
}

TEST_F(FilmCli, AStereoPictureHasTwoEyes) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "takes long: set OSTEON_LONG=1";
  const std::string line = "render --case builtin:fast_box#hull --size 160x90 --out ";
  const Ran ran = run_osteon(line + file("s.png") + " --stereo side-by-side");
  if (no_opengl(ran)) GTEST_SKIP() << ran.output;
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_GT(fs::file_size(file("s.png")), 100u);
  EXPECT_EQ(run_osteon(line + file("t.png") + " --stereo cinema").exit_code, 2);
  EXPECT_EQ(run_osteon(line + file("t.png") + " --view ap --stereo anaglyph").exit_code, 2);
  EXPECT_EQ(run_osteon(line + file("t.png") + " --stereo anaglyph --screen-depth 0").exit_code, 2);
  EXPECT_EQ(run_osteon(line + file("t.png") + " --eye-distance 6").exit_code, 2);
  EXPECT_FALSE(fs::exists(file("t.png")));
}

}  // namespace
}  // namespace osteon::testing_cli
