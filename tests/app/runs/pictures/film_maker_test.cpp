#include "runs/pictures/film_maker.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "film_ball.h"
#include "osteon/render/renderer.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr FilmFormat kFilm{96, 64, 10, true};
constexpr FilmPace kPace{0, 10, kFilm.fps, 1};

class FilmMakerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (auto context = OffscreenContext::create(); !context)
      GTEST_SKIP() << "no OpenGL without a window here: " << context.error().message();
    dir_ = fs::temp_directory_path() / ("osteon_film_maker_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }

  Result<FilmPainter> painter() const {
    return FilmPainter::create(case_, {}, {}, false,
                               {FilmView::kOutside, kFilm.width, kFilm.height});
  }
  static Result<void> beep(std::span<float> block) {
    for (std::size_t s = 0; s < block.size(); ++s) block[s] = static_cast<float>(s % 100) / 200;
    return {};
  }
  Result<std::unique_ptr<FilmMaker>> maker(const char* name, FilmMaker::MakePainter make,
                                           FilmMaker::MakeSound sound = beep) const {
    auto writer = FilmWriter::create(dir_ / name, kFilm);
    EXPECT_TRUE(writer);
    return FilmMaker::create(std::move(make), std::move(*writer), std::move(sound),
                             FilmSofts(*case_, nullptr), kPace);
  }
  void play(FilmMaker& film) const {
    for (std::uint64_t tick = 1; tick <= 1000; ++tick)
      film.see(0, testing::tool_across_ball(tick), rest_snapshot(*case_));
  }
  std::string bytes(const char* name) const {
    std::ifstream in(dir_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(dir_), fs::directory_iterator());
  }

  fs::path dir_;
  std::shared_ptr<const Case> case_ = testing::a_ball();
};

// The film is the one that is drawn and written picture by picture on one thread.
TEST_F(FilmMakerTest, MakesTheFilmOfPainterAndWriter) {
  auto film = maker("made.webm", [this] { return painter(); });
  ASSERT_TRUE(film) << film.error().message();
  play(**film);
  ASSERT_TRUE((*film)->finish());

  auto writer = FilmWriter::create(dir_ / "plain.webm", kFilm);
  auto draws = painter();
  ASSERT_TRUE(writer && draws);
  for (std::uint64_t k = 0; k < kPace.pictures; ++k) {
    FilmMoment moment;
    moment.bones = rest_snapshot(*case_);
    moment.tools[0] = testing::tool_across_ball(std::max<std::uint64_t>(1, 100 * k));
    moment.time_s = moment.tools[0].time_s;
    std::vector<float> sound(kSoundHz / kFilm.fps);
    ASSERT_TRUE(beep(sound));
    ASSERT_TRUE(writer->add_sound(sound));
    const auto image = draws->draw(moment);
    ASSERT_TRUE(image);
    ASSERT_TRUE(writer->add_picture(image->rgb));
  }
  ASSERT_TRUE(writer->finish());
  EXPECT_GT(bytes("plain.webm").size(), 1000u);
  EXPECT_EQ(bytes("made.webm"), bytes("plain.webm"));
}

TEST_F(FilmMakerTest, WhereNothingCanBeDrawnThereIsNoFilm) {
  {
    const auto film =
        maker("none.webm", []() -> Result<FilmPainter> { return fail("is broken", "the screen"); });
    ASSERT_FALSE(film);
    EXPECT_NE(film.error().message().find("the screen"), std::string::npos);
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(FilmMakerTest, WithoutTicksOrSoundItSaysWhyAndLeavesNothing) {
  {
    auto empty = maker("empty.webm", [this] { return painter(); });
    ASSERT_TRUE(empty);
    EXPECT_FALSE((*empty)->finish());
    auto mute = maker(
        "mute.webm", [this] { return painter(); },
        [](std::span<float>) -> Result<void> { return fail("ends", "the recording"); });
    ASSERT_TRUE(mute);
    play(**mute);
    EXPECT_FALSE((*mute)->good());
    const auto ended = (*mute)->finish();
    ASSERT_FALSE(ended);
    EXPECT_NE(ended.error().message().find("the recording"), std::string::npos);
  }
  EXPECT_EQ(files(), 0);
}

}  // namespace
}  // namespace osteon
