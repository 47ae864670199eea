#include "osteon/media/film_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "libav.h"
#include "read_film.h"
#include "yuv.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr int kWide = 64, kHigh = 48;

using Picture = std::vector<std::uint8_t>;

/// A white square on black whose left edge stands at `x`.
Picture square_at(int x, int width = kWide, int height = kHigh) {
  Picture rgb(3u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  for (int row = 12; row < 28; ++row)
    for (int column = x; column < x + 16; ++column)
      for (int c = 0; c < 3; ++c)
        rgb[static_cast<std::size_t>(3 * (row * width + column) + c)] = 255;
  return rgb;
}

/// Pixels that hardly any encoder makes small.
Picture grain(std::uint64_t seed) {
  Picture rgb(3u * kWide * kHigh);
  for (std::uint8_t& byte : rgb) {
    seed = seed * 6364136223846793005ull + 1442695040888963407ull;
    byte = static_cast<std::uint8_t>(seed >> 56);
  }
  return rgb;
}

class FilmWriterTest : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_film_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  std::string file(const char* name) const { return (dir_ / name).string(); }

  /// Ten pictures in one second, the square moving right by 3 pixels each, and a tone of 440 Hz.
  void write_second(const std::string& to) {
    auto film = FilmWriter::create(to, {kWide, kHigh, 10, true});
    ASSERT_TRUE(film) << film.error().message();
    for (int k = 0; k < 10; ++k) {
      std::vector<float> tone;
      for (int s = 0; s < kSoundHz / 10; ++s)
        tone.push_back(static_cast<float>(
            0.5 * std::sin(2 * 3.14159265358979 * 440 * (s + k * kSoundHz / 10.0) / kSoundHz)));
      ASSERT_TRUE(film->add_sound(tone));
      ASSERT_TRUE(film->add_picture(square_at(4 + 3 * k)));
    }
    const auto done = film->finish();
    ASSERT_TRUE(done) << done.error().message();
  }
  fs::path dir_;
};

TEST_F(FilmWriterTest, AFormatOutOfRangeIsRefusedAndLeavesNothing) {
  for (const FilmFormat& format :
       {FilmFormat{8, 48}, FilmFormat{64, 5000}, FilmFormat{64, 48, 0}, FilmFormat{64, 48, 121}})
    EXPECT_FALSE(FilmWriter::create(file("a.webm"), format));
  EXPECT_FALSE(FilmWriter::create(file("no/such/folder.webm"), {}));
  EXPECT_FALSE(FilmWriter::create(dir_, {}));
  EXPECT_TRUE(fs::is_empty(dir_));
}

TEST_F(FilmWriterTest, WithoutFfmpegItSaysWhatToInstall) {
  const std::vector<std::string> files = {"libosteon_no_such_library.so.7"};
  const auto av = load_libav(files);
  ASSERT_FALSE(av);
  EXPECT_NE(av.error().message().find("libosteon_no_such_library.so.7"), std::string::npos);
  EXPECT_NE(av.error().message().find("libavcodec" + std::to_string(LIBAVCODEC_VERSION_MAJOR)),
            std::string::npos);
  const std::vector<std::string> wrong = {"libm.so.6"};
  const auto lacking = load_libav(wrong);
  ASSERT_FALSE(lacking);
  EXPECT_NE(lacking.error().message().find("avformat_alloc_output_context2"), std::string::npos);
}

TEST_F(FilmWriterTest, WhatIsWrittenIsReadBack) {
  write_second(file("a.webm"));
  EXPECT_FALSE(fs::exists(file("a.webm.part")));
  const ReadFilm film = read_film(file("a.webm"));
  EXPECT_NE(film.format.find("webm"), std::string::npos) << film.format;
  EXPECT_EQ(film.picture_codec, "vp9");
  EXPECT_EQ(film.sound_codec, "opus");
  EXPECT_EQ(film.width, kWide);
  EXPECT_EQ(film.height, kHigh);
  EXPECT_EQ(film.sound_hz, kSoundHz);
  EXPECT_NEAR(film.duration_s, 1, 0.05);
  ASSERT_EQ(film.pictures.size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_NEAR(film.times_s[k], 0.1 * static_cast<double>(k), 0.002);
    // The square stands where it was drawn: white in its middle, black left and right of it.
    const std::uint8_t* row = film.pictures[k].data() + 20 * kWide;
    const std::size_t x = 4 + 3 * k;
    EXPECT_NEAR(row[x + 8], 235, 14) << k;
    EXPECT_NEAR(row[x - 3], 16, 30) << k;
    EXPECT_NEAR(row[x + 19 < kWide ? x + 19 : x - 3], 16, 30) << k;
  }
  // Opus keeps the tone, and gives it at its own place.
  ASSERT_GT(film.sound.size(), 44000u);
  const std::vector<float> middle(film.sound.begin() + 9600, film.sound.begin() + 38400);
  EXPECT_NEAR(level_at(middle, 440, kSoundHz), 0.5, 0.05);
  EXPECT_LT(level_at(middle, 700, kSoundHz), 0.02);
}

TEST_F(FilmWriterTest, TheSamePicturesGiveTheSameBytes) {
  write_second(file("a.webm"));
  write_second(file("b.webm"));
  const auto bytes = [](const std::string& name) {
    std::ifstream in(name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes(file("a.webm")), bytes(file("b.webm")));
}

TEST_F(FilmWriterTest, GivenUpItLeavesWhatWasThereBefore) {
  std::ofstream(file("a.webm")) << "before";
  {
    auto film = FilmWriter::create(file("a.webm"), {kWide, kHigh, 10, false});
    ASSERT_TRUE(film);
    ASSERT_TRUE(film->add_picture(square_at(4)));
    EXPECT_FALSE(film->add_picture(Picture(7)));
  }
  EXPECT_EQ(fs::file_size(file("a.webm")), 6u);
  EXPECT_FALSE(fs::exists(file("a.webm.part")));
}

// A limit of the process stands for a disk without room.
TEST_F(FilmWriterTest, AFullDiskKeepsAFilmThatPlays) {
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  rlimit small = limit;
  small.rlim_cur = 60000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  auto film = FilmWriter::create(file("a.webm"), {kWide, kHigh, 10, false});
  Result<void> done;
  int taken = 0;
  for (; film && done && taken < 400; ++taken)
    done = film->add_picture(grain(static_cast<std::uint64_t>(taken)));
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, before);
  ASSERT_TRUE(film) << film.error().message();
  ASSERT_FALSE(done) << taken;
  EXPECT_NE(done.error().message().find("the disk is full"), std::string::npos)
      << done.error().message();
  EXPECT_NE(done.error().message().find("is kept"), std::string::npos);
  EXPECT_FALSE(film->finish());
  ASSERT_TRUE(fs::exists(file("a.webm")));
  EXPECT_FALSE(fs::exists(file("a.webm.part")));
  const ReadFilm read = read_film(file("a.webm"));
  EXPECT_EQ(read.picture_codec, "vp9");
  EXPECT_GT(read.pictures.size(), 5u);
  EXPECT_LE(read.pictures.size(), static_cast<std::size_t>(taken));
}

TEST_F(FilmWriterTest, ADeviceWithoutRoomSaysSo) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  auto film = FilmWriter::create("/dev/full", {kWide, kHigh, 10, false});
  Result<void> done;
  if (film) done = film->add_picture(square_at(4));
  if (film && done) done = film->finish();
  const std::string said = film ? done ? "" : done.error().message() : film.error().message();
  EXPECT_NE(said.find("the disk is full"), std::string::npos) << said;
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

// Colours with their values as the standard has them: white, black, and BT.709's primaries.
TEST(Yuv, ColoursAreThoseOfTheStandard) {
  const struct {
    std::array<std::uint8_t, 3> rgb;
    int y, cb, cr;
  } colours[] = {{{255, 255, 255}, 235, 128, 128}, {{0, 0, 0}, 16, 128, 128},
                 {{255, 0, 0}, 63, 102, 240},      {{0, 255, 0}, 173, 42, 26},
                 {{0, 0, 255}, 32, 240, 118},      {{128, 128, 128}, 126, 128, 128}};
  for (const auto& colour : colours) {
    std::vector<std::uint8_t> rgb;
    for (int k = 0; k < 9; ++k) rgb.insert(rgb.end(), colour.rgb.begin(), colour.rgb.end());
    std::array<std::uint8_t, 9> y{};
    std::array<std::uint8_t, 4> cb{}, cr{};
    to_yuv420(rgb, 3, 3, {y.data(), 3}, {cb.data(), 2}, {cr.data(), 2});
    for (const std::uint8_t v : y) EXPECT_NEAR(v, colour.y, 1);
    for (const std::uint8_t v : cb) EXPECT_NEAR(v, colour.cb, 1);
    for (const std::uint8_t v : cr) EXPECT_NEAR(v, colour.cr, 1);
  }
}

}  // namespace
}  // namespace osteon
