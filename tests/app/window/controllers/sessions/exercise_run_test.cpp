#include "window/controllers/sessions/exercise_run.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "cases/open_case.h"
#include "exercises/scenario_files.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

class ExerciseRunTest : public ::testing::Test {
 protected:
  void SetUp() override {
    dir_ = fs::temp_directory_path() / ("osteon_exercise_" + std::to_string(::getpid()));
    fs::create_directories(dir_);
    ::setenv("XDG_DATA_HOME", dir_.c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("XDG_DATA_HOME");
    fs::remove_all(dir_);
  }
  // Begins touch_bones on the built-in wrist.
  void begin(const std::string& exercise = "touch_bones") {
    run_.toggle();
    ASSERT_TRUE(run_.choose(exercise));
    const auto opened = open_case(run_.case_spec(), {}, CaseParts::kFelt);
    ASSERT_TRUE(opened) << opened.error().message();
    case_ = *opened;
    ASSERT_TRUE(run_.plan(case_));
    run_.begin(0.001, dir_ / "none.osr");
  }
  // The tip rests on a bone with a force for some ticks, and leaves it.
  void touch(const char* bone, double force_n, int ticks) {
    for (int i = 0; i < ticks + 5; ++i) {
      ToolState tool;
      tool.tick = ++tick_;
      tool.time_s = 0.001 * static_cast<double>(tick_);
      tool.epoch = epoch_;
      if (i < ticks) {
        tool.contact_count = 1;
        tool.contacts[0].bone = case_->find(bone);
        tool.contacts[0].force_on_tool_W = {0, 0, force_n};
        tool.contacts[0].depth_m = 1e-4;
        tool.force_W = {0, 0, force_n};
      }
      run_.take(0, tool);
    }
  }
  fs::path dir_;
  ExerciseRun run_;
  std::shared_ptr<const Case> case_;
  std::uint64_t tick_ = 0;
  std::uint32_t epoch_ = 0;  ///< how often the hand went back to a restore point
};

TEST_F(ExerciseRunTest, TheCourseListsWhatIsShippedTheFirstExerciseFirst) {
  EXPECT_EQ(run_.model().page, ExercisePage::kClosed);
  run_.toggle();
  const ExerciseModel course = run_.model();
  EXPECT_EQ(course.page, ExercisePage::kCourse);
  ASSERT_GE(course.cards.size(), 8u);
  EXPECT_EQ(course.cards[0].title, "Touch the bones of the wrist");
  EXPECT_TRUE(course.cards[0].played.empty());
  EXPECT_FALSE(run_.choose("no_such_exercise"));
  run_.choose(99);
  EXPECT_EQ(run_.page(), ExercisePage::kCourse);
  run_.toggle();
  EXPECT_EQ(run_.page(), ExercisePage::kClosed);
}

TEST_F(ExerciseRunTest, PagesCloseButWhatRunsGoesOn) {
  run_.close_page();
  EXPECT_EQ(run_.page(), ExercisePage::kClosed);
  run_.toggle();
  run_.close_page();
  EXPECT_EQ(run_.page(), ExercisePage::kClosed);
  run_.toggle();
  ASSERT_TRUE(run_.choose("touch_bones"));
  run_.close_page();
  EXPECT_EQ(run_.page(), ExercisePage::kClosed) << "a briefing";
  begin();
  run_.close_page();
  EXPECT_EQ(run_.page(), ExercisePage::kRunning);
}

TEST_F(ExerciseRunTest, TheBriefingTellsStagesErrorsAndAims) {
  run_.toggle();
  ASSERT_TRUE(run_.choose("touch_bones"));
  const ExerciseModel briefing = run_.model();
  EXPECT_EQ(briefing.stages.size(), 3u);
  EXPECT_EQ(briefing.faults.size(), 4u);
  EXPECT_EQ(briefing.limit_s, 600);
  EXPECT_EQ(run_.case_spec(), "builtin:wrist#hull");
  run_.set_seed(3);
  EXPECT_EQ(run_.case_spec().rfind("builtin:wrist:3", 0), 0u) << run_.case_spec();
  run_.back();
  EXPECT_EQ(run_.page(), ExercisePage::kCourse);
}

// A graft and portals come from exercises of their own, and where portals lie is known later.
TEST_F(ExerciseRunTest, WhatWasMadeBeforeLeavesOutItsStages) {
  run_.toggle();
  ASSERT_TRUE(run_.choose("acl"));
  const std::size_t whole = run_.model().stages.size();
  const std::string spec = run_.case_spec();
  EXPECT_FALSE(run_.use_graft("{}", "graft.json"));
  EXPECT_FALSE(run_.use_portals("{}", "puncture.json"));
  EXPECT_EQ(run_.model().stages.size(), whole);
  EXPECT_TRUE(run_.graft_report().empty());
  ASSERT_TRUE(run_.use_graft(
      R"({"length_mm": 103, "diameter_mm": 9, "loop_mm": 15, "pretension_s": 600})", "graft.json"));
  EXPECT_EQ(run_.model().stages.size(), whole - 8) << "incision to pretension, and the button";
  EXPECT_NE(run_.graft_report().find("\"loop_mm\": 15"), std::string::npos) << "for an expert";
  EXPECT_FALSE(run_.portals_to_place());
  const std::string portal =
      R"({"off": {"in_mm": 0, "up_mm": 1, "middle_mm": 2}, "shaft": {"in": 1, "up": 0, "middle": 0}})";
  const auto used = run_.use_portals(R"({"portals": {"patient": "builtin:knee", "portal_al": )" +
                                         portal + R"(, "portal_am": )" + portal + "}}",
                                     "puncture.json");
  ASSERT_TRUE(used) << used.error().message();
  EXPECT_EQ(run_.model().stages.size(), whole - 14);
  EXPECT_EQ(run_.model().stages.front().title, "The notch");
  EXPECT_TRUE(run_.portals_to_place());
  run_.set_placed("builtin:knee#portal_al=1/2/3/1/0/0");
  EXPECT_FALSE(run_.portals_to_place());
  EXPECT_EQ(run_.case_spec(), "builtin:knee#portal_al=1/2/3/1/0/0");
  run_.set_seed(3);
  EXPECT_TRUE(run_.portals_to_place()) << "of another patient they are elsewhere";
  run_.set_seed({});
  ASSERT_TRUE(run_.choose("acl"));
  EXPECT_EQ(run_.model().stages.size(), whole);
  EXPECT_EQ(run_.case_spec(), spec);
}

TEST_F(ExerciseRunTest, APartOfItIsChosenByItsStages) {
  run_.toggle();
  ASSERT_TRUE(run_.choose("touch_bones"));
  const auto in_part = [&] {
    std::vector<bool> in;
    for (const auto& stage : run_.model().stages) in.push_back(stage.in_part);
    return in;
  };
  EXPECT_EQ(in_part(), (std::vector<bool>{true, true, true}));
  EXPECT_FALSE(run_.model().parted);
  EXPECT_TRUE(run_.model().stages[1].can_begin);
  EXPECT_FALSE(run_.choose_part("forearm", "carpals"));
  EXPECT_FALSE(run_.choose_part("elbow", ""));
  EXPECT_FALSE(run_.model().parted) << "nothing changed";
  ASSERT_TRUE(run_.choose_part("metacarpals", "metacarpals"));
  EXPECT_EQ(in_part(), (std::vector<bool>{false, true, false}));
  EXPECT_TRUE(run_.model().parted);
  ASSERT_TRUE(run_.choose_part("", "metacarpals"));
  EXPECT_EQ(in_part(), (std::vector<bool>{true, true, false}));
  EXPECT_FALSE(run_.order_of_begin({}, {})) << "nothing comes before it";
  ASSERT_TRUE(run_.choose_part("", ""));
  EXPECT_FALSE(run_.model().parted);
}

// One key does not end it: once more within some seconds does.
TEST_F(ExerciseRunTest, ToEndItIsAskedForTwice) {
  begin();
  touch("capitate", 0, 100);
  run_.follow({});
  EXPECT_FALSE(run_.wants_to_end());
  EXPECT_TRUE(run_.wants_to_end());
  begin();
  EXPECT_FALSE(run_.wants_to_end()) << "of another attempt";
  touch("capitate", 0, 6000);
  run_.follow({});
  EXPECT_FALSE(run_.wants_to_end()) << "long ago";
  EXPECT_TRUE(run_.wants_to_end());
}

// A stage whose start has a name of its own is gone to though nobody came to it: the attempt ends,
// and a part of the exercise that begins there is what is opened next.
TEST_F(ExerciseRunTest, AStartThatWasNotReachedIsBegunAnew) {
  auto text = open_scenario("touch_bones")->source_text;
  for (const char* stage : {"name = \"metacarpals\"", "name = \"forearm\""})
    text.insert(text.find(stage), "restore_title = \"Here\"\n");
  const fs::path file = dir_ / "named.toml";
  std::ofstream(file) << text;
  begin(file.string());
  EXPECT_FALSE(run_.can_begin_anew_at(0)) << "it has no name";
  EXPECT_FALSE(run_.can_begin_anew_at(3)) << "there is no such stage";
  EXPECT_TRUE(run_.model().stages[2].anew);
  EXPECT_EQ(run_.model().stages[2].restore_title, "Here");
  ASSERT_TRUE(run_.can_begin_anew_at(1));
  EXPECT_FALSE(run_.leave_for(0));
  (void)run_.leave_for(1);  // there is no recording to which what was said could be added
  EXPECT_EQ(run_.page(), ExercisePage::kBriefing);
  EXPECT_FALSE(run_.can_begin_anew_at(7));
  EXPECT_FALSE(run_.state()) << "nothing of the attempt is left";
  ASSERT_TRUE(run_.order_of_begin({}, {}));
  EXPECT_EQ(run_.order_of_begin({}, {})->part, (AttemptPart{"metacarpals", "forearm", 0}));
}

TEST_F(ExerciseRunTest, ToGoToSuchAStartIsAskedForTwice) {
  begin();
  touch("capitate", 0, 100);
  run_.follow({});
  EXPECT_FALSE(run_.wants_to_leave_for(1));
  EXPECT_FALSE(run_.wants_to_leave_for(2)) << "of another stage";
  EXPECT_FALSE(run_.wants_to_end()) << "something else is asked for";
  EXPECT_FALSE(run_.wants_to_leave_for(2));
  EXPECT_TRUE(run_.wants_to_leave_for(2));
}

TEST_F(ExerciseRunTest, ItIsOverAtItsTimeLimit) {
  begin();
  tick_ = 599990;
  touch("lunate", 1, 4);
  run_.follow(rest_snapshot(*case_));
  EXPECT_FALSE(run_.over());
  touch("lunate", 1, 4);
  run_.follow(rest_snapshot(*case_));
  EXPECT_TRUE(run_.over());
}

TEST_F(ExerciseRunTest, StagesAndErrorsAreFollowedTickByTick) {
  begin();
  EXPECT_FALSE(run_.follow(rest_snapshot(*case_))) << "nothing happened yet";
  EXPECT_EQ(run_.model().goals, 8u);
  EXPECT_EQ(run_.model().left.size(), 8u);
  touch("lunate", 1, 300);
  touch("capitate", 1, 100);  // too short
  EXPECT_FALSE(run_.follow(rest_snapshot(*case_)));
  EXPECT_EQ(run_.model().left.size(), 7u);
  EXPECT_NEAR(run_.model().elapsed_s, 0.41, 1e-9);
  touch("capitate", 6, 300);
  run_.follow(rest_snapshot(*case_));
  ASSERT_EQ(run_.model().faults.size(), 1u);
  EXPECT_EQ(run_.model().faults[0].title, "Pressed too hard");
  EXPECT_EQ(run_.model().faults[0].where, "Capitate");
  for (const char* bone :
       {"scaphoid", "triquetrum", "pisiform", "trapezium", "trapezoid", "hamate"})
    touch(bone, 1, 300);
  EXPECT_TRUE(run_.follow(rest_snapshot(*case_))) << "the next stage can be come back to";
  EXPECT_TRUE(run_.model().stages[0].done);
  EXPECT_TRUE(run_.model().stages[1].live);
  EXPECT_FALSE(run_.over());
  run_.show_cue();
  run_.show_cue();
  EXPECT_EQ(run_.model().hints, 1);
  EXPECT_FALSE(run_.model().cue.empty());
}

// What was touched since a restore point is to be touched again, from the hand's first tick after
// it on; what was touched before it is not.
TEST_F(ExerciseRunTest, GoesBackWithTheRun) {
  begin();
  const BoneSnapshot rest = rest_snapshot(*case_);
  touch("lunate", 1, 300);
  run_.follow(rest);
  ASSERT_EQ(run_.model().left.size(), 7u);
  run_.see_mark(4);
  for (const char* bone :
       {"capitate", "scaphoid", "triquetrum", "pisiform", "trapezium", "trapezoid", "hamate"})
    touch(bone, 1, 300);
  ASSERT_TRUE(run_.follow(rest));
  ASSERT_TRUE(run_.model().stages[0].done);
  run_.go_back(9);  // nobody set it
  ++epoch_;
  touch("lunate", 1, 10);
  run_.follow(rest);
  EXPECT_TRUE(run_.model().stages[1].live);
  run_.go_back(4);
  run_.follow(rest);
  EXPECT_TRUE(run_.model().stages[1].live) << "the hand has not gone back yet";
  ++epoch_;
  touch("capitate", 1, 300);
  run_.follow(rest);
  EXPECT_TRUE(run_.model().stages[0].live);
  EXPECT_FALSE(run_.model().stages[0].done);
  EXPECT_EQ(run_.model().left.size(), 6u) << "lunate before the mark, capitate after it";
}

TEST_F(ExerciseRunTest, InAPauseTheTimeStandsAndNothingIsJudged) {
  begin();
  touch("lunate", 1, 300);
  run_.follow(rest_snapshot(*case_));
  const double before_s = run_.model().elapsed_s;
  run_.pause(true);
  EXPECT_TRUE(run_.model().paused);
  touch("capitate", 6, 400);  // too hard, and it would count
  run_.follow(rest_snapshot(*case_));
  EXPECT_DOUBLE_EQ(run_.model().elapsed_s, before_s);
  EXPECT_TRUE(run_.model().faults.empty());
  EXPECT_EQ(run_.model().left.size(), 7u);
  run_.pause(false);
  EXPECT_FALSE(run_.model().paused);
  touch("hamate", 1, 300);
  run_.follow(rest_snapshot(*case_));
  EXPECT_EQ(run_.model().left.size(), 6u);
  EXPECT_NEAR(run_.model().elapsed_s, before_s + 0.305, 1e-9);
  EXPECT_TRUE(run_.model().faults.empty());
}

TEST_F(ExerciseRunTest, WhatIsFoundIsAskedForAndKeptUntilTheEnd) {
  run_.toggle();
  ASSERT_TRUE(run_.choose("wrist_tour"));
  EXPECT_TRUE(run_.model().asked.empty()) << "not before it runs";
  auto wrist = open_case("builtin:wrist#hull", {}, CaseParts::kFelt);
  ASSERT_TRUE(wrist);
  ASSERT_TRUE(run_.plan(*wrist)) << run_.model().problem;
  run_.begin(0.001, dir_ / "none.osr");
  ASSERT_EQ(run_.model().asked.size(), 2u);
  EXPECT_EQ(run_.model().asked[0].grades.size(), 4u);
  EXPECT_TRUE(run_.model().asked[0].stated.empty());
  run_.state_finding("geissler", "3");
  EXPECT_EQ(run_.model().asked[0].stated, "3");
  run_.state_finding("geissler", "");
  EXPECT_TRUE(run_.model().asked[0].stated.empty());
}

TEST_F(ExerciseRunTest, ARecordingThatIsNotThereIsSaid) {
  begin();
  run_.judge();
  EXPECT_EQ(run_.page(), ExercisePage::kJudging);
  run_.toggle();
  EXPECT_EQ(run_.page(), ExercisePage::kJudging) << "it cannot be closed meanwhile";
  run_.wait_for_verdict();
  run_.poll();
  EXPECT_EQ(run_.page(), ExercisePage::kResult);
  EXPECT_NE(run_.model().problem.find("none.osr"), std::string::npos) << run_.model().problem;
  EXPECT_FALSE(run_.save_pages(dir_ / "x.pdf"));
}

}  // namespace
}  // namespace osteon
