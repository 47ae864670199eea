#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/ui/ui_frame.h"

namespace osteon {
namespace {

using test::small_model;
using test::UiFrame;

void fill_hands(UiFrame& ui) {
  UiModel model = small_model();
  model.width = ui.model.width;
  model.height = ui.model.height;
  model.hands.rows = {{"Right", "Hook probe", "", true, false}};
  model.hands.can_add = true;
  model.hands.restore_points = 1;
  model.hand.probe_by_mouse = true;
  ui.model = std::move(model);
}

TEST(HandsPanel, EachKeyAsksForItsOwnThing) {
  UiFrame ui;
  fill_hands(ui);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_X).hands.change);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_T).hands.toggle_tray);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_K).hands.mark);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_U).hands.undo);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_Z, false, true).hands.undo);
  EXPECT_FALSE(ui.press_key(GLFW_KEY_Z).hands.undo);
  EXPECT_EQ(ui.press_key(GLFW_KEY_PAGE_DOWN).hands.step, 1);
  EXPECT_EQ(ui.press_key(GLFW_KEY_PAGE_UP).hands.step, -1);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_END).hands.next_size);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_L).hands.toggle_names);
}

TEST(HandsPanel, AReplayHasNothingToExchange) {
  UiFrame ui;
  fill_hands(ui);
  ui.model.replay.on = true;
  ui.model.replay.duration_s = 1;
  EXPECT_FALSE(ui.press_key(GLFW_KEY_X).hands.change);
  EXPECT_FALSE(ui.press_key(GLFW_KEY_U).hands.undo);
  EXPECT_EQ(ui.press_key(GLFW_KEY_PAGE_DOWN).hands.step, 0);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_L).hands.toggle_names);
}

TEST(HandsPanel, TheHandsHaveButtonsToo) {
  UiFrame ui;
  fill_hands(ui);
  EXPECT_TRUE(ui.click("##hand", {"2nd hand  (X)"}).hands.change);
  ui.model.hands.rows.push_back({"Left", "Grasper", "3-4", false, true});
  EXPECT_TRUE(ui.click("##hand", {"Change  (X)"}).hands.change);
  EXPECT_TRUE(ui.click("##hand", {"Undo  (U)"}).hands.undo);
  ui.model.hands.restore_points = 0;
  EXPECT_FALSE(ui.click("##hand", {"Undo  (U)"}).hands.undo);
}

TEST(HandsPanel, KeysTurnWhatAMouseHolds) {
  UiFrame ui;
  fill_hands(ui);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_Z).hands.upright);
  const UiRequests turned = ui.press_key(GLFW_KEY_Y);
  EXPECT_TRUE(turned.exercise.as_expert);
  EXPECT_FALSE(turned.exercise.to_expert) << "only with Shift";
  EXPECT_FALSE(turned.hands.upright);
}

TEST(TrayPanel, AnInstrumentIsTakenByAClickAndFoundByItsName) {
  UiFrame ui;
  fill_hands(ui);
  ui.model.hands.tray.open = true;
  ui.model.hands.tray.items = {{"Wrist probe", "", "probe", 0, -1},
                               {"Grasper", "", "grasp", 1, -1},
                               {"Cannulated drill", "9 mm", "drive", 2, -1}};
  for (int i = 0; i < 3; ++i) ui.draw();
  ASSERT_TRUE(ui.shown("##tray"));
  const UiRect tray = ui.rect("##tray");
  // The second row, whatever child window it is in.
  const UiRequests taken = ui.click({tray.x + 120, tray.y + 50 + 68 + 30});
  ASSERT_TRUE(taken.hands.take);
  EXPECT_EQ(*taken.hands.take, 1u);
  ui.model.hands.tray.search = "DRILL";
  const UiRequests found = ui.click({tray.x + 120, tray.y + 50 + 30});
  ASSERT_TRUE(found.hands.take);
  EXPECT_EQ(*found.hands.take, 2u);
  for (const char* words : {"drill 9", "9mm drill", "cannulated, drill"}) {
    ui.model.hands.tray.search = words;
    const UiRequests by_words = ui.click({tray.x + 120, tray.y + 50 + 30});
    EXPECT_EQ(by_words.hands.take.has_value(), std::string(words) != "9mm drill") << words;
  }
}

TEST(TrayPanel, WhereNothingIsFoundOneSearchesOn) {
  UiFrame ui;
  fill_hands(ui);
  ui.model.hands.tray.open = true;
  ui.model.hands.tray.items = {{"Wrist probe", "", "probe", 0, -1}};
  ui.model.hands.tray.search = "saw";
  for (int i = 0; i < 3; ++i) ui.draw();
  EXPECT_FALSE(ui.press_key(GLFW_KEY_ENTER).hands.take);
  for (int i = 0; i < 3; ++i) ui.draw();
  EXPECT_FALSE(ui.press_key(GLFW_KEY_R).toggle_record) << "letters still go into the search";
}

// R would end what is recorded, P would pause it.
TEST(TrayPanel, LettersGoIntoTheSearchAndAreNobodysKeys) {
  UiFrame ui;
  fill_hands(ui);
  ui.model.hands.tray.items = {{"Wrist probe", "", "probe", 0, -1},
                               {"Grasper", "", "grasp", 1, -1}};
  EXPECT_TRUE(ui.press_key(GLFW_KEY_R).toggle_record) << "the tray is not open";
  ui.model.hands.tray.open = true;
  for (int i = 0; i < 3; ++i) ui.draw();
  for (const int key : {GLFW_KEY_R, GLFW_KEY_X, GLFW_KEY_U, GLFW_KEY_T, GLFW_KEY_J}) {
    const UiRequests none = ui.press_key(key);
    EXPECT_FALSE(none.toggle_record || none.hands.change || none.hands.undo ||
                 none.hands.toggle_tray || none.exercise.toggle)
        << key;
  }
  ImGui::GetIO().AddInputCharacter('g');
  const UiRequests typed = ui.draw();
  ASSERT_TRUE(typed.hands.search);
  EXPECT_EQ(*typed.hands.search, "g");
  EXPECT_EQ(ui.press_key(GLFW_KEY_PAGE_DOWN).hands.step, 1);
  EXPECT_EQ(ui.press_key(GLFW_KEY_PAGE_UP).hands.step, -1);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_END).hands.next_size);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_ESCAPE).force_off);
  ui.model.hands.tray.search = "gra";
  const UiRequests first = ui.press_key(GLFW_KEY_ENTER);
  ASSERT_TRUE(first.hands.take) << "the first that was found";
  EXPECT_EQ(*first.hands.take, 1u);
}

TEST(TrayPanel, WhatAnExerciseUsesStandsUnderAHeading) {
  UiFrame ui;
  fill_hands(ui);
  TrayModel& tray = ui.model.hands.tray;
  tray.open = true;
  tray.items = {{"Grasper", "", "grasp", 1, -1}, {"Wrist probe", "", "probe", 0, -1}};
  const auto taken_at = [&](float y) {
    for (int i = 0; i < 3; ++i) ui.draw();
    const UiRect r = ui.rect("##tray");
    return ui.click({r.x + 120, r.y + y}).hands.take;
  };
  EXPECT_EQ(taken_at(31 + 6), 1u);
  tray.items[0].used = true;
  EXPECT_FALSE(taken_at(31 + 6)) << "the heading";
  EXPECT_EQ(taken_at(31 + 18 + 60), 1u);
  EXPECT_FALSE(taken_at(31 + 18 + 68 + 6)) << "the next heading";
  EXPECT_EQ(taken_at(31 + 2 * 18 + 68 + 30), 0u);
}

TEST(TrayPanel, TheSizesOfAnInstrumentShareARowAndEachCanBeTaken) {
  UiFrame ui;
  fill_hands(ui);
  ui.model.hands.tray.open = true;
  ui.model.hands.tray.items = {{"Cannulated drill", "9 mm", "drive", 3, -1},
                               {"Grasper", "", "grasp", 1, -1},
                               {"Cannulated drill", "4.5 mm", "drive", 2, -1},
                               {"Cannulated drill", "10 mm", "drive", 4, -1}};
  for (int i = 0; i < 3; ++i) ui.draw();
  const UiRect tray = ui.rect("##tray");
  const float text_x = tray.x + 8 + 64 + 12 + 8, top = tray.y + 31;
  const UiRequests row = ui.click({tray.x + 250, top + 10});
  ASSERT_TRUE(row.hands.take) << "by its name: the one that comes first";
  EXPECT_EQ(*row.hands.take, 3u);
  const UiRequests smallest = ui.click({text_x + 17, top + 50});
  ASSERT_TRUE(smallest.hands.take) << "sizes stand in order";
  EXPECT_EQ(*smallest.hands.take, 2u);
  const UiRequests largest = ui.click({text_x + 2 * 37 + 17, top + 50});
  ASSERT_TRUE(largest.hands.take);
  EXPECT_EQ(*largest.hands.take, 4u);
  const UiRequests next_row = ui.click({tray.x + 200, top + 46 + 24 + 4 + 30});
  ASSERT_TRUE(next_row.hands.take);
  EXPECT_EQ(*next_row.hands.take, 1u);
}

TEST(BrowserPanel, OpensByKeyListsAndClosesInsideTheWindow) {
  for (const ImVec2 size : {ImVec2(800, 600), ImVec2(1280, 720)}) {
    UiFrame ui(size.x, size.y);
    fill_hands(ui);
    EXPECT_TRUE(ui.press_key(GLFW_KEY_O).browser.toggle);
    ui.model.browser.open = true;
    ui.model.browser.folder = "/home";
    ui.model.browser.known = {{OpenKind::kCase, "Wrist", "built in", "builtin:wrist"}};
    ui.model.browser.files = {{OpenKind::kFolder, "data", "folder", "/home/data"}};
    for (int i = 0; i < 3; ++i) ui.draw();
    const UiRect all = ui.rect("##browser");
    ASSERT_GT(all.w, 0);
    EXPECT_LE(all.bottom(), size.y);
    EXPECT_LE(all.right(), size.x);
    const ImVec2 close = ui.find("##browser", {"Close  (O)"});
    ASSERT_GT(close.x, 0);
    EXPECT_TRUE(ui.click(close).browser.toggle);
    const UiRequests opened = ui.click({all.x + 60, all.y + 76});
    ASSERT_TRUE(opened.browser.open);
    EXPECT_EQ(opened.browser.open->path, "builtin:wrist");
  }
}

TEST(HelpPanel, ItsCloseButtonIsInSightInASmallWindow) {
  for (const ImVec2 size : {ImVec2(640, 400), ImVec2(800, 600), ImVec2(1280, 720)}) {
    UiFrame ui(size.x, size.y);
    fill_hands(ui);
    ui.model.help_open = true;
    EXPECT_TRUE(ui.click("##help", {"Close  (F1)"}).toggle_help) << size.x;
    EXPECT_LE(ui.rect("##help").bottom(), size.y);
  }
}

TEST(HandPanel, AMouseThatTrippedIsNotLockedOut) {
  UiFrame ui;
  fill_hands(ui);
  ui.model.hand.info.peak_force_n = 0;
  ui.model.hand.status.cause = ForceOff::kVelocity;
  EXPECT_LT(ui.find("##hand", {"Resume"}).x, 0);
  ui.model.hand.info.peak_force_n = 8;
  EXPECT_GT(ui.find("##hand", {"Resume"}).x, 0);
}

TEST(CasePanel, ItsEdgeIsDragged) {
  UiFrame ui;
  fill_hands(ui);
  for (int i = 0; i < 3; ++i) ui.draw();
  const UiRect card = ui.rect("##case");
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {card.right() + 1, card.y + 30};
  ui.draw();
  ui.draw();
  io.MouseDown[0] = true;
  ui.draw();
  io.MousePos.x += 50;
  const UiRequests dragged = ui.draw();
  ASSERT_TRUE(dragged.left_card);
  EXPECT_NEAR(*dragged.left_card, static_cast<double>(card.w) + 51, 1.5);
}

}  // namespace
}  // namespace osteon
