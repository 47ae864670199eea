#include "osteon/record/recording_note.h"

#include <gtest/gtest.h>

#include <fstream>

#include "osteon/record/recording.h"
#include "record_fixtures.h"

namespace osteon {
namespace {

using testing::expect_prefix;
using testing::TempFolder;
using testing::write_recording;

TEST(RecordingNote, ComesBackAndLeavesTheRecordingAsItWas) {
  TempFolder folder;
  write_recording(folder / "r.osr", 500);
  const std::string text = std::string("a = \"\xc3\xa4\"\n") + std::string(100000, 'x');
  ASSERT_TRUE(write_note(folder / "r.osr", "scenario", "old"));
  ASSERT_TRUE(write_note(folder / "r.osr", "scenario", text));
  EXPECT_EQ(**read_note(folder / "r.osr", "scenario"), text);
  EXPECT_FALSE(read_note(folder / "r.osr", "report")->has_value());
  const auto loaded = load_recording(folder / "r.osr");
  ASSERT_TRUE(loaded) << loaded.error().message();
  EXPECT_TRUE(loaded->complete);
  EXPECT_EQ(loaded->ticks.size(), 500u);
  expect_prefix(*loaded);
}

TEST(RecordingNote, RefusesWhatIsNoRecordingAndNoNote) {
  TempFolder folder;
  EXPECT_FALSE(write_note(folder / "none.osr", "scenario", "x"));
  EXPECT_FALSE(read_note(folder / "none.osr", "scenario"));
  std::ofstream(folder / "text.osr") << "no recording at all, but long enough to be looked at";
  EXPECT_FALSE(write_note(folder / "text.osr", "scenario", "x"));
  write_recording(folder / "r.osr", 10);
  EXPECT_FALSE(write_note(folder / "r.osr", "", "x"));
  EXPECT_FALSE(write_note(folder / "r.osr", std::string(61, 'n'), "x"));
  EXPECT_FALSE(write_note(folder / "r.osr", "n", std::string((4u << 20) + 1, 'x')));
}

}  // namespace
}  // namespace osteon
