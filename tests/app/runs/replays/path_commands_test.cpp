// What a path takes from a tray.
#include "runs/replays/path_commands.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

ProbePath hook_then_shaver(double hook_mm, double shaver_mm) {
  ProbePath path;
  path.with_instruments = true;
  for (int i = 0; i < 2; ++i) {
    PathSample sample;
    sample.time_s = i;
    sample.instrument = i == 0 ? "hook_probe" : "shaver";
    sample.size_mm = i == 0 ? hook_mm : shaver_mm;
    path.samples.push_back(sample);
  }
  return path;
}

// The window's tray writes every size, as in hook_probe:3.0.
TEST(PathCommands, ASizeIsFoundHoweverTheTrayWritesIt) {
  const std::vector<std::string> tray{"wrist_probe", "shaver:3.5", "hook_probe:3.0", "shaver:4.2"};
  PathCommands commands(hook_then_shaver(3, 4.2), tray);
  EXPECT_EQ(commands.first_instrument(), 2u);
  EXPECT_EQ(commands.at(0).kind, CommandKind::kNone);
  const Command taken = commands.at(1);
  EXPECT_EQ(taken.kind, CommandKind::kTake);
  EXPECT_EQ(taken.value, 3);
}

TEST(PathCommands, WithoutASizeTheNameIsFound) {
  const std::vector<std::string> tray{"hook_probe", "shaver"};
  PathCommands commands(hook_then_shaver(0, 0), tray);
  EXPECT_EQ(commands.first_instrument(), 0u);
  EXPECT_EQ(commands.at(1).value, 1);
}

TEST(PathCommands, AnotherSizeIsNotTaken) {
  const std::vector<std::string> tray{"wrist_probe", "hook_probe:4.0", "shaver:4.2"};
  PathCommands commands(hook_then_shaver(3, 4.2), tray);
  EXPECT_EQ(commands.first_instrument(), 0u);
  EXPECT_EQ(commands.at(1).value, 2);
}

}  // namespace
}  // namespace osteon
