#include "exercises/ghost/begun_attempt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "cases/open_case.h"
#include "commands/teaching/scenario_run.h"
#include "exercises/debrief.h"
#include "osteon/record/recording_note.h"
#include "runs/hands/tray.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

// The expert touches the bones of the wrist once for all tests.
class BegunAttemptTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    dir = fs::temp_directory_path() / ("osteon_begun_" + std::to_string(::getpid()));
    fs::create_directories(dir);
    ::setenv("XDG_CACHE_HOME", (dir / "cache").c_str(), 1);
    const auto scenario = open_scenario("touch_bones");
    ASSERT_TRUE(scenario) << scenario.error().message();
    wanted = {*scenario, case_spec_of(*scenario, "", std::nullopt)};
    const auto opened = open_case(wanted.case_spec, {}, CaseParts::kFelt);
    ASSERT_TRUE(opened) << opened.error().message();
    the_case = *opened;
    wanted.case_hash = the_case->hash;
    ScenarioRun run;
    run.scenario = wanted.scenario;
    run.case_spec = wanted.case_spec;
    run.skill = *parse_skill(wanted.scenario, "expert");
    run.record_to = expert_recording(wanted);
    fs::create_directories(run.record_to->parent_path());
    const auto done = run_scenario(run);
    ASSERT_TRUE(done) << done.error().message();
    expert = done->outcome;
  }
  static void TearDownTestSuite() {
    ::unsetenv("XDG_CACHE_HOME");
    fs::remove_all(dir);
    the_case.reset();
  }
  void SetUp() override {
    fs::remove(file);
    auto planned = plan_scenario(wanted.scenario, *the_case);
    ASSERT_TRUE(planned);
    plan = std::move(*planned);
    auto held = plan_hands(wanted.scenario, *the_case);
    ASSERT_TRUE(held);
    hands = std::move(*held);
  }
  BegunAttemptOrder order_of(const AttemptPart& part) {
    RunTray tray;
    tray.names = {"hook_probe", kWristProbe};  // in another order than the expert's, and more
    tray.tools = *make_tray(tray.names, SessionSettings{}.probe_radius_m);
    const auto place = [names = tray.names](const std::string& name) {
      const auto at = std::find(names.begin(), names.end(), name.empty() ? kWristProbe : name);
      return at == names.end() ? std::nullopt
                               : std::optional(static_cast<std::uint32_t>(at - names.begin()));
    };
    return {wanted, part, &plan, hands, the_case, {}, tray, place, file, "/nowhere/osteon"};
  }
  // What the expert does after the begin, by the same inputs.
  static void do_the_rest(BegunRun& run) {
    const auto recorded = load_recording(expert_recording(wanted));
    ASSERT_TRUE(recorded);
    for (std::size_t i = run.tools[0].tick; i < recorded->ticks.size(); ++i) {
      (void)run.session->tick(recorded->ticks[i].input);
      if (run.session->last_steps() > 0) run.feed->push(run.session->last_step_record());
      run.feed->push(0, run.session->last_tick_record(), run.session->last_events());
      if (i % 100 == 0) run.feed->drain();
    }
    const auto closed = run.feed->finish();
    ASSERT_TRUE(closed) << closed.error().message();
  }
  Result<Debrief> judged(const AttemptPart& part) const {
    EXPECT_TRUE(note_attempt(file, wanted.scenario, std::nullopt, "a person", ""));
    EXPECT_TRUE(write_note(file, "part", to_text(part)));
    DebriefOrder order{file, "", "", ""};
    double told = 0;
    order.on_share = [&](double share) {
      EXPECT_GE(share, told);
      told = share;
    };
    auto debrief = make_debrief(order);
    EXPECT_GT(told, 0.95);
    return debrief;
  }

  inline static fs::path dir;
  inline static GhostWanted wanted;
  inline static std::shared_ptr<const Case> the_case;
  inline static Outcome expert;
  ScenarioPlan plan;
  std::vector<PlannedHand> hands;
  fs::path file = dir / "attempt.osr";
};

bool go_on(const char*, double) { return true; }

// Two stages by the expert, the last by who goes on: the recording holds both, and the verdict is
// about the last.
TEST_F(BegunAttemptTest, WhoGoesOnIsJudgedByThePartAlone) {
  std::vector<double> told;
  auto begun = begin_attempt(order_of({"forearm", "forearm"}), [&](const char* what, double share) {
    if (what) told.push_back(share);
    return true;
  });
  ASSERT_TRUE(begun) << begun.error().message();
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end())) << "progress only grows";
  ASSERT_FALSE(told.empty());
  EXPECT_GT(told.back(), 0.9);
  const double from_s = *expert.stages[1].completed_s;
  EXPECT_NEAR(begun->watch->part_from_s(), from_s, 1e-9) << "as soon as the stage before is done";
  EXPECT_EQ(begun->watch->now_s(), 0);
  EXPECT_EQ(begun->watch->state().stage, 2u);
  EXPECT_EQ(begun->run.tools[0].tick, begun->part.from_tick);
  EXPECT_EQ(begun->run.settings.tray, order_of({}).tray.names);
  EXPECT_EQ(begun->run.tools[0].instrument, 1u) << "the wrist probe, where the run's tray has it";
  do_the_rest(begun->run);
  const auto debrief = judged(begun->part);
  ASSERT_TRUE(debrief) << debrief.error().message();
  EXPECT_TRUE(debrief->identical);
  const Outcome& outcome = *debrief->outcome;
  ASSERT_EQ(outcome.stages.size(), 1u);
  EXPECT_EQ(outcome.stages[0].name, "forearm");
  ASSERT_TRUE(outcome.stages[0].completed_s);
  EXPECT_NEAR(*outcome.stages[0].completed_s, *expert.stages[2].completed_s - from_s, 1e-9);
  EXPECT_TRUE(outcome.errors.empty());
  EXPECT_EQ(outcome.verdict, Verdict::kUndecided) << "there is no standard for a part";
  EXPECT_FALSE(outcome.score);
  EXPECT_NEAR(outcome.metrics.at("elapsed_s"), expert.metrics.at("elapsed_s") - from_s, 1e-6);
  EXPECT_LT(outcome.metrics.at("path_mm"), 0.7 * expert.metrics.at("path_mm"));
  EXPECT_NEAR(debrief->reports[0].duration_s, expert.metrics.at("elapsed_s") - from_s, 1e-6);
  EXPECT_LT(debrief->hands[0].time_s.front(), 0.1);
  EXPECT_NE(report_of(*debrief).find("\"part\""), std::string::npos);
}

TEST_F(BegunAttemptTest, APartThatEndsEarlyIsOverThere) {
  auto begun = begin_attempt(order_of({"metacarpals", "metacarpals"}), go_on);
  ASSERT_TRUE(begun) << begun.error().message();
  do_the_rest(begun->run);
  const auto debrief = judged(begun->part);
  ASSERT_TRUE(debrief) << debrief.error().message();
  ASSERT_EQ(debrief->outcome->stages.size(), 1u);
  EXPECT_TRUE(debrief->outcome->stages[0].completed_s);
  EXPECT_TRUE(debrief->outcome->errors.empty()) << "bones of the next stage are not left out";
}

TEST_F(BegunAttemptTest, WhatIsStoppedOrCannotBeLeavesNothing) {
  int asked = 0;
  auto stopped = begin_attempt(order_of({"forearm", "forearm"}),
                               [&](const char* what, double) { return !what || ++asked < 3; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().what, "stopped");
  EXPECT_FALSE(fs::exists(file));
  EXPECT_FALSE(begin_attempt(order_of({"forearm", "elbow"}), go_on)) << "no such stage";
  EXPECT_FALSE(begin_attempt(order_of({"carpals", "carpals"}), go_on)) << "nothing is before it";
  BegunAttemptOrder bare = order_of({"forearm", "forearm"});
  bare.place = [](const std::string&) { return std::nullopt; };
  const auto without =
      begin_attempt(bare, [](const char* what, double) { return what != nullptr; });
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().message().find("the tray has no"), std::string::npos);
  EXPECT_FALSE(fs::exists(file));
  EXPECT_TRUE(fs::exists(expert_recording(wanted))) << "the expert's is not to blame";
  BegunAttemptOrder nowhere = order_of({"forearm", "forearm"});
  const fs::path no_folder = dir / "no_folder";
  std::ofstream(no_folder) << "a file";
  nowhere.file = no_folder / "attempt.osr";
  EXPECT_FALSE(begin_attempt(nowhere, [](const char* what, double) { return what != nullptr; }));
}

// Who has just installed the program begins with a part.
TEST_F(BegunAttemptTest, TheFirstRecordingOfAllMakesItsFolder) {
  BegunAttemptOrder first = order_of({"forearm", "forearm"});
  first.file = dir / "data" / "recordings" / "attempt.osr";
  std::vector<std::string> told;
  auto begun = begin_attempt(first, [&](const char* what, double) {
    if (what) told.emplace_back(what);
    return true;
  });
  ASSERT_TRUE(begun) << begun.error().message();
  EXPECT_TRUE(fs::is_directory(first.file.parent_path()));
  for (const std::string& what : told)
    EXPECT_EQ(what.find("so far"), std::string::npos) << "he need not play again";
}

// Of an expert who was not seen to the end, what comes before the part will do.
TEST_F(BegunAttemptTest, WhoGoesOnToTheEndNeedsTheBeginAlone) {
  GhostWanted begin = wanted;
  begin.to_stage = "metacarpals";
  fs::rename(expert_recording(wanted), expert_recording(begin));
  const auto begun = begin_attempt(order_of({"forearm", "forearm"}), go_on);
  const auto earlier = begin_attempt(order_of({"metacarpals", "forearm"}), go_on);
  fs::rename(expert_recording(begin), expert_recording(wanted));
  EXPECT_TRUE(begun) << begun.error().message();
  EXPECT_FALSE(earlier) << "of what comes before that stage there is none";
}

// What cannot be repeated is recorded anew, by a program that is not there.
TEST_F(BegunAttemptTest, ADamagedRecordingOfTheExpertIsNotUsed) {
  const fs::path kept = dir / "kept.osr";
  fs::copy_file(expert_recording(wanted), kept);
  std::ofstream(expert_recording(wanted)) << "damaged";
  const auto made = begin_attempt(order_of({"forearm", "forearm"}), go_on);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message().find("could not perform"), std::string::npos)
      << made.error().message();
  fs::rename(kept, expert_recording(wanted));
}

}  // namespace
}  // namespace osteon
