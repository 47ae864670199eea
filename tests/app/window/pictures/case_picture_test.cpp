#include "window/pictures/case_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "osteon/base/file.h"

namespace osteon {
namespace {
namespace fs = std::filesystem;

class CasePictures : public ::testing::Test {
 protected:
  CasePictures()
      : folder(fs::path(::testing::TempDir()) / ("osteon_pictures_" + std::to_string(::getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder / "case");
  }
  ~CasePictures() override { fs::remove_all(folder); }

  static Image picture() {
    Image image{3, 2, {}};
    for (int i = 0; i < 18; ++i) image.rgb.push_back(static_cast<std::uint8_t>(10 * i));
    return image;
  }
  fs::path only_file() const { return fs::directory_iterator(folder / "kept")->path(); }

  fs::path folder;
};

TEST_F(CasePictures, OneThatIsKeptIsFoundUnderItsNameAlone) {
  const CasePictureStore store(folder / "kept");
  EXPECT_FALSE(store.find("builtin:wrist"));
  store.keep("builtin:wrist", picture());
  const auto found = store.find("builtin:wrist");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->width, 3);
  EXPECT_EQ(found->height, 2);
  EXPECT_EQ(found->rgb, picture().rgb);
  EXPECT_FALSE(store.find("builtin:knee"));
}

TEST_F(CasePictures, ACaseThatWasWrittenAnewHasNone) {
  const CasePictureStore store(folder / "kept");
  const std::string spec = (folder / "case").string();
  const fs::path description = folder / "case" / "case.toml";
  ASSERT_TRUE(write_file_atomic(description, "name = 'a'"));
  store.keep(spec, picture());
  EXPECT_TRUE(store.find(spec));
  EXPECT_TRUE(store.find(spec)) << "looking does not change it";
  fs::last_write_time(description, fs::last_write_time(description) + std::chrono::seconds(5));
  EXPECT_FALSE(store.find(spec));
}

TEST_F(CasePictures, ADamagedFileIsNoPicture) {
  const CasePictureStore store(folder / "kept");
  store.keep("builtin:wrist", picture());
  const std::string whole = *read_file(only_file());
  for (const std::string& bad :
       {std::string(), whole.substr(0, whole.size() - 1), whole + "x", std::string("P6 3 2 255"),
        std::string("P6 3"), std::string("P6 -3 2 255\n"), std::string("P6 99999 99999 255\n"),
        std::string("P5 3 2 255\n") + whole.substr(11)}) {
    ASSERT_TRUE(write_file_atomic(only_file(), bad));
    EXPECT_FALSE(store.find("builtin:wrist")) << bad;
  }
}

TEST_F(CasePictures, WithoutAFolderToWriteToNothingIsKeptAndNothingBreaks) {
  ASSERT_TRUE(write_file_atomic(folder / "a_file", "x"));
  const CasePictureStore store(folder / "a_file" / "kept");
  store.keep("builtin:wrist", picture());
  EXPECT_FALSE(store.find("builtin:wrist"));
}

TEST_F(CasePictures, WhatCannotBeOpenedOrWasStoppedIsAnError) {
  const auto go_on = [](const char*, double) { return true; };
  const auto missing = draw_case_picture((folder / "none").string(), 32, 24, go_on);
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message().find("none"), std::string::npos);
  const auto stop = [](const char*, double) { return false; };
  EXPECT_FALSE(draw_case_picture("builtin:wrist:31", 32, 24, stop));
}

TEST_F(CasePictures, TheBonesStandInTheMiddleOfThePicture) {
  const auto go_on = [](const char*, double) { return true; };
  const auto image = draw_case_picture("builtin:wrist", 48, 32, go_on);
  if (!image && image.error().message().find("OpenGL") != std::string::npos)
    GTEST_SKIP() << image.error().message();
  ASSERT_TRUE(image) << image.error().message();
  ASSERT_EQ(image->rgb.size(), 48u * 32u * 3u);
  const auto light_between = [&](std::size_t first, std::size_t end) {
    int light = 0;
    for (std::size_t row = 8; row < 24; ++row)
      for (std::size_t column = first; column < end; ++column)
        light += image->rgb[3 * (48 * row + column)] > 100;
    return light;
  };
  EXPECT_GT(light_between(16, 32), 100);
  EXPECT_LT(light_between(0, 4) + light_between(44, 48), 40) << "the sides are background";
}

}  // namespace
}  // namespace osteon
