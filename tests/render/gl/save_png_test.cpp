#include <gtest/gtest.h>

#include <filesystem>

#include "osteon/base/file.h"
#include "osteon/render/renderer.h"

namespace osteon {
namespace {

std::filesystem::path scratch(const std::string& name) {
  return std::filesystem::path(::testing::TempDir()) / name;
}

/// Big-endian number at a byte of a PNG.
unsigned number_at(const std::string& png, std::size_t byte) {
  unsigned value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value = value << 8 | static_cast<unsigned char>(png[byte + k]);
  return value;
}

TEST(SavePng, RefusesAnEmptyOrInconsistentPicture) {
  EXPECT_FALSE(save_png({}, scratch("osteon_empty.png")).has_value());
  EXPECT_FALSE(save_png({2, 2, {1, 2, 3}}, scratch("osteon_short.png")).has_value());
  EXPECT_FALSE(save_png({-1, -1, {1, 2, 3}}, scratch("osteon_negative.png")).has_value());
}

TEST(SavePng, NamesAFolderThatIsNotThere) {
  const auto saved = save_png({1, 1, {1, 2, 3}}, "/nowhere/at/all.png");
  ASSERT_FALSE(saved.has_value());
  EXPECT_NE(saved.error().message().find("/nowhere/at/all.png"), std::string::npos);
}

TEST(SavePng, WritesAPngOfThatSize) {
  const Image image{3, 2, {255, 0, 0, 0, 255, 0, 0, 0, 255, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
  const auto file = scratch("osteon_small.png");
  ASSERT_TRUE(save_png(image, file).has_value());
  const auto png = read_file(file);
  ASSERT_TRUE(png.has_value());
  EXPECT_EQ(png->substr(1, 3), "PNG");
  EXPECT_EQ(number_at(*png, 16), 3u);
  EXPECT_EQ(number_at(*png, 20), 2u);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace osteon
