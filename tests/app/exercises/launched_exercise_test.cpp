#include "exercises/launched_exercise.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "exercises/result_files.h"
#include "osteon/results/names.h"
#include "results/attempts.h"
#include "results/loopback_lms.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;
using test::LoopbackLms;

class LaunchedExerciseTest : public ::testing::Test {
 protected:
  void SetUp() override { ::setenv("XDG_DATA_HOME", dir_.c_str(), 1); }
  void TearDown() override {
    ::unsetenv("XDG_DATA_HOME");
    fs::remove_all(dir_);
  }
  Result<LaunchedExercise> run(const LoopbackLms& lms, const PlayLaunched& play) {
    return run_launched(*parse_cmi5_launch(lms.launch_url()), {}, play);
  }
  fs::path dir_ = fs::temp_directory_path() / ("osteon_launched_" + std::to_string(::getpid()));
};

TEST_F(LaunchedExerciseTest, TheLearnerIsAnIdAndTheAccountsNameStaysHere) {
  LoopbackLms lms;
  std::string whose;
  const auto done = run(lms, [&](const Cmi5Launch& launch, const std::string& learner) {
    whose = learner;
    AttemptRow row = test::row_of(1, 1);
    row.scenario = launch.scenario;
    return Result<std::optional<AttemptRow>>(row);
  });
  ASSERT_TRUE(done) << done.error().message();
  lms.stop();
  EXPECT_EQ(lms.verbs(), "initialized passed terminated");  // its report has no stages
  EXPECT_TRUE(is_learner_id(whose));
  EXPECT_EQ(whose.find("student"), whose.npos);
  EXPECT_EQ(load_names(names_file())->at(whose), "student 7 & co");
}

TEST_F(LaunchedExerciseTest, ASessionThatWasOpenedIsEndedThoughNothingCouldBePlayed) {
  LoopbackLms lms;
  const auto done = run(lms, [](const Cmi5Launch&, const std::string&) {
    return Result<std::optional<AttemptRow>>(fail("no patient", "here"));
  });
  ASSERT_TRUE(done);
  lms.stop();
  EXPECT_TRUE(done->not_played);
  EXPECT_EQ(lms.verbs(), "initialized terminated");
}

// The next launch takes along what this one could not send, at its end: nobody waits for that
// before the exercise begins.
TEST_F(LaunchedExerciseTest, WhatWaitsGoesWithTheNextLaunch) {
  LoopbackLms lms;
  const PlayLaunched nothing = [](const Cmi5Launch&, const std::string&) {
    return Result<std::optional<AttemptRow>>(std::nullopt);
  };
  lms.busy(1000);
  const auto first = run(lms, nothing);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sent.waiting, 2u);
  EXPECT_TRUE(first->sent.why_waiting);
  lms.busy(0);
  const auto second = run(lms, nothing);
  ASSERT_TRUE(second);
  lms.stop();
  EXPECT_EQ(second->sent.accepted, 4u);
  EXPECT_EQ(second->sent.waiting, 0u);
  EXPECT_EQ(lms.verbs(), "initialized initialized terminated terminated");
}

}  // namespace
}  // namespace osteon
