#include "osteon/scene/case_notes.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <limits>

namespace osteon {
namespace {

std::string refused(std::string_view text) {
  const auto notes = parse_notes(text, "notes.toml");
  return notes ? std::string() : notes.error().message();
}

std::string refused(const CaseNote& note) {
  const auto sound = check_note(note, "note 1");
  return sound ? std::string() : sound.error().message();
}

TEST(CaseNotes, NamesTheLineOfWhatIsWrong) {
  EXPECT_NE(refused("").find("format"), std::string::npos);
  EXPECT_NE(refused("format = 2\n").find("format"), std::string::npos);
  EXPECT_NE(refused("format = 1\nnote = 3\n").find("'note' is unknown"), std::string::npos);
  const std::string head = "format = 1\n[[notes]]\n";
  EXPECT_NE(refused(head + "position_m = [0, 0, 0]\n").find("'text' is missing"),
            std::string::npos);
  EXPECT_NE(refused(head + "text = \"a\"\n").find("'position_m' is missing"), std::string::npos);
  EXPECT_NE(refused(head + "text = \"a\"\nposition_m = [0, nan, 0]\n").find("notes.toml:4"),
            std::string::npos);
  EXPECT_NE(refused(head + "text = \" \"\nposition_m = [0, 0, 0]\n").find("has no text"),
            std::string::npos);
  EXPECT_NE(refused(head + "text = 3\nposition_m = [0, 0, 0]\n").find("must be text"),
            std::string::npos);
  EXPECT_NE(refused("format = 1\n[[notes]\n").find("notes.toml:2"), std::string::npos);
}

TEST(CaseNotes, RefusesWhatIsNoNote) {
  EXPECT_EQ(refused(CaseNote{"fits", "", Vec3(0, 0, 1.9)}), "");
  EXPECT_NE(refused(CaseNote{"", "", Vec3::Zero()}), "");
  EXPECT_NE(refused(CaseNote{"two\nlines", "", Vec3::Zero()}), "");
  EXPECT_NE(refused(CaseNote{"half a character \xc3", "", Vec3::Zero()}), "");
  EXPECT_NE(refused(CaseNote{"\xff", "", Vec3::Zero()}), "");
  EXPECT_NE(refused(CaseNote{std::string(501, 'a'), "", Vec3::Zero()}), "");
  EXPECT_NE(refused(CaseNote{"far", "", Vec3(0, 0, 2.1)}), "");
  EXPECT_NE(refused(CaseNote{"nan", "", Vec3::Constant(std::numeric_limits<double>::quiet_NaN())}),
            "");
}

TEST(CaseNotes, WhatIsSavedReadsBackTheSame) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("osteon_case_notes_" + std::to_string(::getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(load_notes(folder));
  EXPECT_TRUE(load_notes(folder)->empty());
  const CaseNotes notes = {{"The \"waist\" \\ breaks \xc3\xa4", "scaphoid", Vec3(0.1, -1e-17, 0.3)},
                           {"Portal", "", Vec3(0, 0, 1)}};
  ASSERT_TRUE(save_notes(notes, folder));
  const auto read = load_notes(folder);
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(*read, notes);
  ASSERT_TRUE(save_notes({}, folder));
  EXPECT_FALSE(std::filesystem::exists(folder / "notes.toml"));
  ASSERT_TRUE(save_notes({}, folder));
  std::ofstream(folder / "notes.toml") << "format = 1\n[[notes]]\n";
  EXPECT_FALSE(load_notes(folder));
  std::filesystem::remove_all(folder);
}

TEST(CaseNotes, ACaseHasNoMoreThanTwoHundred) {
  CaseNotes notes(200, {"a", "", Vec3::Zero()});
  EXPECT_TRUE(parse_notes(notes_text(notes), "notes.toml"));
  notes.push_back(notes.front());
  EXPECT_FALSE(parse_notes(notes_text(notes), "notes.toml"));
}

}  // namespace
}  // namespace osteon
