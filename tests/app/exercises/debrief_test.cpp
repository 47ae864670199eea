#include "exercises/debrief.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "cases/open_case.h"
#include "commands/support/headless.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBox = "builtin:fast_box";
constexpr const char* kTouchTheFloor = R"(format = 1
name = "floor"
title = "The floor"
text = "Touch it."
version = 1
anatomy = "fast_box"
time_limit_s = 60

[[stages]]
name = "touch"
title = "Touch"
instruction = "Touch the floor."
[[stages.goals]]
rule = "touched"
bones = ["floor"]
for_s = 0.1
force_n = 0.3

[[stages]]
name = "post"
title = "Post"
instruction = "Touch a post."
[[stages.goals]]
rule = "touched"
bones = ["post_1"]
for_s = 0.1
force_n = 0.3
)";

// Down to the floor beside the posts, half a millimetre into it, and up again.
ProbePath one_touch() {
  ProbePath path;
  for (const auto& [time_s, z_mm] :
       {std::pair{0.0, 8.0}, {0.4, 0.25}, {1.0, 0.25}, {1.4, 8.0}, {3.0, 8.0}}) {
    PathSample at;
    at.time_s = time_s;
    at.X_WD = {Vec3(0.060, 0.060, 0.001 * z_mm), Quat::Identity()};
    path.samples.push_back(at);
  }
  return path;
}

class DebriefTest : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_debrief_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
    std::ofstream(dir_ / "floor.toml") << kTouchTheFloor;
  }
  void TearDown() override { fs::remove_all(dir_); }

  // When the first stage was done; below 0: not. `restore_s`: then the session goes back to a
  // restore point that was set at `mark_s`.
  double first_done_s(double mark_s, double restore_s) {
    const auto opened = open_case(kBox, {}, CaseParts::kFelt);
    EXPECT_TRUE(opened) << opened.error().message();
    HeadlessRun run;
    run.the_case = *opened;
    run.case_source = kBox;
    run.path = one_touch();
    run.record_to = dir_ / "run.osr";
    const auto step_of = [&](double s) {
      return static_cast<int>(std::lround(s / run.settings.physics.step_s));
    };
    int step = 0;
    run.beside = [&, mark = step_of(mark_s),
                  back = step_of(restore_s)]() -> std::optional<Command> {
      ++step;
      if (step == mark) return Command{CommandKind::kMark, 5};
      if (step == back) return Command{CommandKind::kRestore, 5};
      return std::nullopt;
    };
    fs::remove(*run.record_to);
    const auto ran = simulate_hands(run);
    EXPECT_TRUE(ran) << ran.error().message();
    const auto debrief = make_debrief({*run.record_to, "", (dir_ / "floor.toml").string(), ""});
    EXPECT_TRUE(debrief) << debrief.error().message();
    if (!debrief || !debrief->outcome) return -2;
    return debrief->outcome->stages.at(0).completed_s.value_or(-1);
  }

  fs::path dir_;
};

// What was done since a restore point is judged as not done; what was done before it stays.
TEST_F(DebriefTest, GoesBackToRestorePointsOfTheRecording) {
  const double done_s = first_done_s(0.1, 9);
  EXPECT_NEAR(done_s, 1.1, 0.3) << "the floor was touched";
  EXPECT_LT(first_done_s(0.1, 2.0), 0) << "back to before the touch";
  EXPECT_EQ(first_done_s(1.8, 2.2), done_s) << "back to after it";
}

}  // namespace
}  // namespace osteon
