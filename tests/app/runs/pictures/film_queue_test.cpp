#include "runs/pictures/film_queue.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr FilmFormat kSmall{64, 48, 10, true};

class FilmQueueTest : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_film_queue_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
  }
  void TearDown() override { fs::remove_all(dir_); }
  std::string file(const char* name) const { return (dir_ / name).string(); }
  std::size_t count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(dir_), fs::directory_iterator()));
  }
  static std::string bytes(const std::string& name) {
    std::ifstream in(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static Image picture(int k) {
    Image image{kSmall.width, kSmall.height, {}};
    for (int i = 0; i < 3 * kSmall.width * kSmall.height; ++i)
      image.rgb.push_back(static_cast<std::uint8_t>(i / 3 % kSmall.width * 3 + 11 * k));
    return image;
  }
  static std::vector<float> tone(int k) {
    std::vector<float> out(kSoundHz / kSmall.fps);
    for (std::size_t s = 0; s < out.size(); ++s)
      out[s] = static_cast<float>((s + static_cast<std::size_t>(k)) % 100) / 200;
    return out;
  }

 private:
  fs::path dir_;
};

TEST_F(FilmQueueTest, MakesTheFilmThatAWriterMakes) {
  auto plain = FilmWriter::create(file("plain.webm"), kSmall);
  auto ahead = FilmWriter::create(file("ahead.webm"), kSmall);
  ASSERT_TRUE(plain && ahead);
  FilmQueue queue(std::move(*ahead));
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(plain->add_sound(tone(k)));
    ASSERT_TRUE(plain->add_picture(picture(k).rgb));
    ASSERT_TRUE(queue.add(tone(k), picture(k)));
  }
  ASSERT_TRUE(plain->finish());
  ASSERT_TRUE(queue.finish());
  EXPECT_GT(bytes(file("plain.webm")).size(), 1000u);
  EXPECT_EQ(bytes(file("ahead.webm")), bytes(file("plain.webm")));
}

TEST_F(FilmQueueTest, OneThatIsGivenUpLeavesNothing) {
  {
    auto writer = FilmWriter::create(file("given_up.webm"), kSmall);
    ASSERT_TRUE(writer);
    FilmQueue queue(std::move(*writer));
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(queue.add(tone(k), picture(k)));
  }
  EXPECT_EQ(count(), 0u);
}

TEST_F(FilmQueueTest, WhatCannotBeWrittenIsTold) {
  auto writer = FilmWriter::create(file("wrong.webm"), kSmall);
  ASSERT_TRUE(writer);
  FilmQueue queue(std::move(*writer));
  Image wrong = picture(0);
  wrong.rgb.resize(30);
  (void)queue.add(tone(0), std::move(wrong));
  // What comes after it waits for nobody.
  for (int k = 1; k < 10; ++k) (void)queue.add(tone(k), picture(k));
  EXPECT_FALSE(queue.add(tone(10), picture(10)));
  const auto ended = queue.finish();
  ASSERT_FALSE(ended);
  EXPECT_NE(ended.error().message().find("size"), std::string::npos) << ended.error().message();
}

}  // namespace
}  // namespace osteon
