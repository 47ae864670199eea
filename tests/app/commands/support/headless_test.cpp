#include "commands/support/headless.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cases/open_case.h"
#include "osteon/record/recording.h"

namespace osteon {
namespace {

ProbePath at_rest(double for_s) {
  ProbePath path;
  path.samples.resize(2);
  for (PathSample& sample : path.samples) sample.X_WD.p = Vec3(0, 0, 0.2);
  path.samples.back().time_s = for_s;
  return path;
}

// Else a goal that depends on the bones is reached a tick earlier than when the recording is judged
// again, and a run that ends with it is told as not done.
TEST(Headless, WhoJudgesSeesTheBonesThatTheRecordedTicksConsumed) {
  const auto the_case = open_case("builtin:wrist");
  ASSERT_TRUE(the_case) << the_case.error().message();
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "judged_bones.osr";
  std::filesystem::remove(file);
  HeadlessRun run;
  run.the_case = *the_case;
  run.case_source = "builtin:wrist";
  run.hands = {{"left", at_rest(0.05)}, {"right", at_rest(0.05)}};
  run.record_to = file;
  std::vector<std::uint64_t> seen;
  run.on_hands = [&](std::span<const ToolState* const>, const BoneSnapshot& bones) {
    seen.push_back(bones.step);
  };
  ASSERT_TRUE(simulate_hands(run));
  const auto recording = load_recording(file);
  ASSERT_TRUE(recording) << recording.error().message();
  std::vector<std::uint64_t> consumed;
  for (const TickRecord& tick : recording->ticks) consumed.push_back(tick.bone_step);
  EXPECT_EQ(seen.size(), 50u);
  EXPECT_GT(seen.back(), 20u);
  EXPECT_EQ(seen, consumed);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace osteon
