#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/ui/ui_frame.h"

namespace osteon {
namespace {

using test::UiFrame;

class ExercisePanel : public ::testing::Test {
 protected:
  ExercisePanel() {
    UiModel model = test::small_model();
    model.width = ui.model.width;
    model.height = ui.model.height;
    ui.model = std::move(model);
  }
  ExerciseModel& at(ExercisePage page) {
    ui.model.exercise = {};
    ui.model.exercise.page = page;
    ui.model.exercise.title = "Touch the bones";
    ui.model.exercise.stages = {{"Carpals", "Touch them", true, false, 12},
                                {"Forearm", "Touch these", false, true, 0}};
    return ui.model.exercise;
  }
  void settle() {
    for (int i = 0; i < 4; ++i) ui.draw();
  }
  // A window's child has a name of its own, which ends with a number.
  std::string child(const std::string& begin) const {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (std::string(window->Name).starts_with(begin)) return window->Name;
    return {};
  }
  // The part of the card above its buttons.
  std::string scrolled() const { return child("##running/scrolled"); }
  UiFrame ui;
};

TEST_F(ExercisePanel, ClosedThereIsNothingAndTheKeyOpensTheCourse) {
  settle();
  EXPECT_FALSE(ui.shown("##exercise"));
  EXPECT_FALSE(ui.shown("##running"));
  EXPECT_TRUE(ui.press_key(GLFW_KEY_J).exercise.toggle);
}

TEST_F(ExercisePanel, OfNoExerciseTheCourseStillStands) {
  at(ExercisePage::kCourse);
  settle();
  EXPECT_TRUE(ui.shown("##exercise"));
  EXPECT_TRUE(ui.click("##exercise", {"Close  (J)"}).exercise.toggle);
}

TEST_F(ExercisePanel, AnExerciseIsChosenFromTheCourse) {
  at(ExercisePage::kCourse).cards = {{"First", "text", ""}, {"Second", "text", "2 attempts"}};
  settle();
  const std::string cards = child("##exercise/cards");
  ASSERT_FALSE(cards.empty());
  EXPECT_FALSE(ui.draw().exercise.choose);
  const ExerciseRequests asked = ui.click(cards.c_str(), {1, "Choose"}).exercise;
  ASSERT_TRUE(asked.choose);
  EXPECT_EQ(*asked.choose, 1u);
}

TEST_F(ExercisePanel, ALongTitleIsShownWholeOnMoreLines) {
  const auto height_with = [&](const std::string& title) {
    at(ExercisePage::kCourse).cards = {{title, "text", ""}};
    settle();
    return ImGui::FindWindowByName(child("##exercise/cards").c_str())->ContentSize.y;
  };
  const float line = height_with("First");
  EXPECT_EQ(height_with("Second"), line);
  const float more = height_with("ACL reconstruction: the graft of two hamstring tendons, folded");
  EXPECT_GT(more, line + 10);
}

TEST_F(ExercisePanel, TheBriefingBeginsByButtonAndByKeyAndGoesBack) {
  at(ExercisePage::kBriefing).faults = {{"Pressed too hard", "major", "A bruise", 0, {}}};
  ui.model.exercise.measures = {{"path_mm", "mm", 0, 3500, true}};
  settle();
  EXPECT_TRUE(ui.click("##exercise", {"Begin  (Enter)"}).exercise.begin);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_ENTER).exercise.begin);
  EXPECT_TRUE(ui.click("##exercise", {"Back"}).exercise.back);
  ui.model.exercise.page = ExercisePage::kOpening;
  settle();
  EXPECT_FALSE(ui.click("##exercise", {"Begin  (Enter)"}).exercise.begin) << "it is under way";
}

TEST_F(ExercisePanel, WhileItRunsItCanBeEndedTakenBackAndAHintAskedFor) {
  ExerciseModel& model = at(ExercisePage::kRunning);
  model.left = {"Radius", "Ulna"};
  model.goals = 2;
  model.has_cue = true;
  settle();
  EXPECT_FALSE(ui.shown("##exercise")) << "the scene stays in sight";
  EXPECT_TRUE(ui.click("##running", {"Hint (I)"}).exercise.hint);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_I).exercise.hint);
  EXPECT_TRUE(ui.click("##running", {"Back (U)"}).exercise.undo);
  EXPECT_TRUE(ui.click("##running", {"End (J)"}).exercise.end);
  const UiRequests key = ui.press_key(GLFW_KEY_J);
  EXPECT_TRUE(key.exercise.end);
  EXPECT_FALSE(key.exercise.toggle);
  model.cue = "They lie in two rows";
  settle();
  EXPECT_FALSE(ui.click("##running", {"Hint (I)"}).exercise.hint) << "it is shown";
}

// It records by itself: the key that ends a recording of one's own would end an hour's work.
TEST_F(ExercisePanel, TheKeyThatRecordsDoesNotEndIt) {
  at(ExercisePage::kClosed);
  settle();
  EXPECT_TRUE(ui.press_key(GLFW_KEY_R).toggle_record);
  at(ExercisePage::kRunning);
  settle();
  EXPECT_FALSE(ui.press_key(GLFW_KEY_R).toggle_record);
}

// A word that is typed before the tray's field has the keyboard presses no keys.
TEST_F(ExercisePanel, OnceTheTrayOpensLettersAreForItsSearchAlone) {
  at(ExercisePage::kRunning);
  settle();
  EXPECT_TRUE(ui.press_key(GLFW_KEY_J).exercise.end);
  ui.model.hands.tray.open = true;
  const UiRequests typed = ui.press_key(GLFW_KEY_J);
  EXPECT_FALSE(typed.exercise.end);
}

// What one works with comes before what one reads.
TEST_F(ExercisePanel, TheSlidersOfAKneeAreInSightWhateverElseIsTold) {
  ExerciseModel& model = at(ExercisePage::kRunning);
  for (int i = 0; i < 40; ++i) model.told.push_back({"Channel", "32.7 mm", "measured"});
  model.knee.shown = true;
  model.knee.most_deg = 130;
  settle();
  const ImVec2 slider = ui.find(scrolled().c_str(), {"##Knee"});
  ASSERT_GE(slider.x, 0);
  EXPECT_LT(slider.y, ui.rect("##running").bottom());
}

// A hand that holds the mouse cannot scroll to them.
TEST_F(ExercisePanel, TheFewLinesThatChangeWhileOneWorksComeBeforeErrors) {
  const auto slider_y = [&](std::size_t lines) {
    ExerciseModel& model = at(ExercisePage::kRunning);
    model.told.assign(lines, {"Torn ends cleared", "61 %", "of both"});
    model.faults.assign(2, {});
    model.knee.shown = true;
    model.knee.most_deg = 130;
    settle();
    return ui.find(scrolled().c_str(), {"##Knee"}).y;
  };
  const float without = slider_y(0);
  EXPECT_GT(slider_y(2), without + 20);
  EXPECT_EQ(slider_y(9), without) << "so many scroll";
}

// Its end says what to do: it is not cut off, and the button that begins stays in the window.
TEST_F(ExercisePanel, WhatKeepsItFromBeginningIsToldWhole) {
  const auto briefing_h = [&](const std::string& problem) {
    at(ExercisePage::kBriefing).problem = problem;
    settle();
    return ui.rect(child("##exercise/briefing").c_str()).h;
  };
  const float of_one_line = briefing_h("Too late");
  EXPECT_LT(briefing_h(std::string(40, 'x') + " " + std::string(40, 'y') + " " +
                       std::string(40, 'z') + " " + std::string(40, 'w')),
            of_one_line - 10);
  EXPECT_TRUE(ui.click("##exercise", {"Begin  (Enter)"}).exercise.begin);
}

// The picture between the cards stays free; the card of the case has the room that is left.
TEST_F(ExercisePanel, WhileItRunsItsCardIsAboveThatOfTheCase) {
  ExerciseModel& model = at(ExercisePage::kRunning);
  model.stages.clear();
  for (int i = 0; i < 15; ++i)
    model.stages.push_back({"Stage " + std::to_string(i), std::string(300, 'x'), i < 7, i == 7, 0});
  ui.model.left_card = kExerciseCard;
  settle();
  const UiRect card = ui.rect("##running"), bones = ui.rect("##case");
  ASSERT_GT(card.h, 0);
  ASSERT_GT(bones.h, 0);
  EXPECT_EQ(card.w, kExerciseCard);
  EXPECT_GE(bones.y, card.bottom());
  EXPECT_LE(bones.bottom(), ui.model.height);
  ui.model.panels_open = false;
  settle();
  EXPECT_GT(ui.rect("##running").h, 0) << "folded it is still there";
  EXPECT_EQ(ui.rect("##case").h, 0);
}

// However much there is to say, the way back and the end are in sight.
TEST_F(ExercisePanel, TheButtonsOfItsCardStayInSight) {
  ExerciseModel& model = at(ExercisePage::kRunning);
  model.stages[1].instruction = std::string(600, 'x');
  model.stages[1].restore_title = "Initial state";
  for (int i = 0; i < 20; ++i) model.told.push_back({"Channel", "32.7 mm", "measured"});
  model.has_cue = true;
  settle();
  const UiRect card = ui.rect("##running");
  EXPECT_LE(card.bottom(), ui.rect("##case").y);
  for (const char* name : {"Pause (P)", "Hint (I)", "Back (U)", "End (J)", "##return"}) {
    const ImVec2 button = ui.find("##running", {name});
    EXPECT_GT(button.y, card.y) << name;
    EXPECT_LT(button.y, card.bottom() - 8) << name;
  }
  const UiRect above = ui.rect(scrolled().c_str());
  EXPECT_LT(above.h, ImGui::FindWindowByName(scrolled().c_str())->ContentSize.y) << "it scrolls";
  model.told.clear();
  model.stages[1].instruction = "Touch these";
  settle();
  EXPECT_LT(ui.rect("##running").h, card.h - 50) << "no higher than it must be";
}

TEST_F(ExercisePanel, OfManyStagesThoseNearTheOneInHandAreListed) {
  const auto height = [&](int stages) {
    ExerciseModel& model = at(ExercisePage::kRunning);
    model.stages.clear();
    for (int i = 0; i < stages; ++i)
      model.stages.push_back({"Stage " + std::to_string(i), "Do it", i < 2, i == 2, 0});
    settle();
    return ui.rect("##running").h;
  };
  EXPECT_GT(height(6), height(5)) << "six are listed one by one";
  EXPECT_LT(height(15), height(6));
  EXPECT_EQ(height(30), height(15));
}

TEST_F(ExercisePanel, ItIsPausedAndGoesOnByButtonAndByKey) {
  ExerciseModel& model = at(ExercisePage::kRunning);
  settle();
  EXPECT_TRUE(ui.click("##running", {"Pause (P)"}).exercise.pause);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_P).exercise.pause);
  model.paused = true;
  settle();
  EXPECT_FALSE(ui.click("##running", {"Pause (P)"}).exercise.pause) << "it says Resume now";
  EXPECT_TRUE(ui.click("##running", {"Resume (P)"}).exercise.pause);
  model.page = ExercisePage::kBriefing;
  settle();
  EXPECT_FALSE(ui.press_key(GLFW_KEY_P).exercise.pause);
}

TEST_F(ExercisePanel, TheExpertBesideTheLearnerIsSwitchedWhereTheExerciseAllowsIt) {
  ExerciseModel& model = at(ExercisePage::kRunning);
  settle();
  EXPECT_FALSE(ui.click(scrolled().c_str(), {"Expert beside me"}).exercise.ghost) << "not allowed";
  model.ghost.allowed = true;
  for (const bool preparing : {true, false})
    for (const double strength : {0.0, 1.0}) {
      model.ghost.preparing = preparing;
      model.ghost.strength = strength;
      settle();
      EXPECT_TRUE(ui.click(scrolled().c_str(), {"Expert beside me"}).exercise.ghost);
    }
  model.ghost.on = false;
  model.ghost.problem = "The recording is of another patient";
  settle();
  EXPECT_TRUE(ui.click(scrolled().c_str(), {"Expert beside me"}).exercise.ghost);
}

TEST_F(ExercisePanel, WhatIsFoundIsStatedByMouse) {
  at(ExercisePage::kRunning).asked = {{"geissler", "Scaphoid", {"1", "2"}, "", ""}};
  settle();
  (void)ui.click(scrolled().c_str(), {"geissler", "##stated"});
  settle();
  const std::string list = child("##Combo");
  ASSERT_FALSE(list.empty());
  const ExerciseRequests asked = ui.click(list.c_str(), {"2"}).exercise;
  ASSERT_TRUE(asked.state);
  EXPECT_EQ(asked.state->first, "geissler");
  EXPECT_EQ(asked.state->second, "2");
}

TEST_F(ExercisePanel, StartsOfStagesAreChosenThoseThatWereNotReachedBelow) {
  ExerciseModel& model = at(ExercisePage::kRunning);
  model.stages[0].restore_title = "Tibia tunnel locating";
  model.stages[0].anew = true;
  model.stages[1].restore_title = "Initial state";
  settle();
  (void)ui.click("##running", {"##return"});
  settle();
  const std::string list = child("##Combo");
  ASSERT_FALSE(list.empty());
  const ImVec2 here = ui.find(list.c_str(), {"Initial state"});
  const ImVec2 ahead = ui.find(list.c_str(), {"Tibia tunnel locating"});
  ASSERT_GT(here.y, 0);
  EXPECT_GT(ahead.y, here.y);
  EXPECT_EQ(ui.click(list.c_str(), {"Tibia tunnel locating"}).exercise.return_to, 0u);
}

TEST_F(ExercisePanel, TheResultCanBeWatchedPrintedAndTriedAgain) {
  ExerciseModel& model = at(ExercisePage::kResult);
  model.verdict = "undecided";
  model.score = 81;
  model.score_lo = 70;
  model.score_hi = 92;
  model.faults = {{"Struck a bone", "major", "Chipped", 3, "Radius"}};
  settle();
  EXPECT_TRUE(ui.click("##exercise", {"Watch it again"}).exercise.watch);
  EXPECT_TRUE(ui.click("##exercise", {"Save as PDF"}).exercise.pages);
  EXPECT_TRUE(ui.click("##exercise", {"Try again"}).exercise.begin);
  EXPECT_TRUE(ui.click("##exercise", {"Exercises"}).exercise.back);
}

// Who has the picture close in looks here for what to do, and not below a list of bones.
TEST_F(ExercisePanel, WhileAScopeIsOnShowTheCardHasThePump) {
  at(ExercisePage::kRunning);
  settle();
  EXPECT_LT(ui.find(scrolled().c_str(), {"##Pump"}).x, 0);
  const auto needed = [&] {
    settle();
    return ImGui::FindWindowByName(scrolled().c_str())->ContentSize.y;
  };
  ui.model.views.water = WaterModel{{8000, 0.5}, 6000, 0.1};
  const float open = needed();
  const ImVec2 at = ui.find(scrolled().c_str(), {"##Pump"});
  ASSERT_GE(at.x, 0);
  ImGui::GetIO().MousePos = {at.x + 20, at.y};
  ui.draw();
  ImGui::GetIO().MouseDown[0] = true;
  const auto pumped = ui.draw().views.water;
  ImGui::GetIO().MouseDown[0] = false;
  ui.draw();
  ASSERT_TRUE(pumped);
  EXPECT_NE(pumped->pump_pa, 8000);
  ui.model.views.water->collapsed = true;
  EXPECT_GT(needed(), open + 10) << "it says why nothing is seen";
}

// Loads come with their sliders once the knee is known, and not where it is bent too far.
TEST_F(ExercisePanel, AKneeIsExaminedBySliders) {
  const auto pressed = [&](const char* slider) {
    settle();
    const ImVec2 at = ui.find(scrolled().c_str(), {slider});
    if (at.x < 0) return ExerciseRequests{};
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {at.x + 60, at.y};
    ui.draw();
    io.MouseDown[0] = true;
    const ExerciseRequests out = ui.draw().exercise;
    io.MouseDown[0] = false;
    ui.draw();
    return out;
  };
  BentKneeModel& knee = at(ExercisePage::kRunning).knee;
  EXPECT_FALSE(pressed("##Knee").bend_deg);
  knee.shown = knee.exam.shown = knee.exam.computing = true;
  knee.most_deg = 130;
  knee.exam.full_n = 134;
  EXPECT_TRUE(pressed("##Knee").bend_deg);
  EXPECT_FALSE(pressed("##Lachman").pull_n);
  EXPECT_FALSE(pressed("##Graft's tail").tension_n);
  knee.exam.computing = false;
  const auto pull = pressed("##Lachman").pull_n, load = pressed("##Pivot shift").pivot_share;
  ASSERT_TRUE(pull && load);
  EXPECT_GT(*pull, 1);
  EXPECT_LE(*pull, 134);
  EXPECT_GT(*load, 0.01);
  EXPECT_LE(*load, 1);
  // Where the knee is not tested, what a stage asks to be seen has their place.
  knee.exam.may = false;
  EXPECT_FALSE(pressed("##Lachman").pull_n);
  EXPECT_FALSE(pressed("##Pivot shift").pivot_share);
  EXPECT_LT(ui.find(scrolled().c_str(), {"##Lachman"}).x, 0);
}

// As wide as the card: a plot of no width shows nothing.
TEST_F(ExercisePanel, TheGraftsLengthIsPlottedOverTheWholeCard) {
  BentKneeModel& knee = at(ExercisePage::kRunning).knee;
  knee.shown = knee.placed = true;
  knee.most_deg = 130;
  knee.flexion_deg = {0, 60, 120};
  knee.between_mm = {24, 21, 23};
  settle();
  const ImVec2 slider = ui.find(scrolled().c_str(), {"##Graft's tail"});
  ASSERT_GE(slider.x, 0);
  const ImVec2 plot = ui.find(scrolled().c_str(), {"##isometry"});
  ASSERT_GE(plot.x, 0);
  EXPECT_GT(plot.y, slider.y);
}

}  // namespace
}  // namespace osteon
