#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "app/ui/ui_frame.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

using test::small_model;
using test::UiFrame;

void fill(UiFrame& ui) {
  UiModel model = small_model();
  model.width = ui.model.width;
  model.height = ui.model.height;
  ui.model = std::move(model);
}

TEST(PanelViews, KeysChooseWhatThePictureShows) {
  UiFrame ui;
  fill(ui);
  EXPECT_EQ(ui.press_key('V').views.layout, PictureLayout::kScope);
  EXPECT_EQ(ui.press_key(GLFW_KEY_F8).views.layout, PictureLayout::kAll);
  EXPECT_EQ(ui.press_key(GLFW_KEY_F9).views.layout, PictureLayout::kFluoro);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_F3).views.toggle_observer);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_F4).views.toggle_film);
  EXPECT_FALSE(ui.press_key('B').views.shoot) << "one is being made";
  ui.model.views.can_shoot = true;
  EXPECT_TRUE(ui.press_key('B').views.shoot);
  ui.model.hand.probe_in_hand = true;
  EXPECT_FALSE(ui.press_key('V').views.layout) << "it runs the motor";
  ui.model.hand.probe_in_hand = false;
  ui.model.phase = UiPhase::kLoading;
  EXPECT_FALSE(ui.press_key('V').views.layout);
}

TEST(PanelViews, TheChooserIsARowOfButtonsInAWideBar) {
  UiFrame wide(1280, 720);
  fill(wide);
  const ImVec2 at = wide.find("##top", {"Panorama"});
  ASSERT_GT(at.x, 0);
  EXPECT_EQ(wide.click_for_views(at).layout, PictureLayout::kPanorama);
}

TEST(PanelViews, TheChooserOpensInANarrowBarBesideTheButtons) {
  UiFrame narrow(640, 480);
  fill(narrow);
  const ImVec2 combo = narrow.find("##top", {"##layout"});
  ASSERT_GT(combo.x, 0);
  EXPECT_LT(combo.x, narrow.find("##top", {"###record"}).x);
  narrow.click(combo);
  narrow.draw();
  const std::string popup = narrow.popup();
  ASSERT_FALSE(popup.empty());
  const ImVec2 all = narrow.find(popup.c_str(), {"All"});
  EXPECT_EQ(narrow.click_for_views(all).layout, PictureLayout::kAll);
}

TEST(PanelViews, AMessageStandsWhereNoHandHoldsAScopeAndOffersOne) {
  UiFrame ui;
  fill(ui);
  ui.model.views.layout = PictureLayout::kScope;
  PaneModel pane{{PaneKind::kScope, {200, 60, 700, 560}, true}, "No hand holds a scope.", true};
  ui.model.views.panes = {pane};
  const ImVec2 at = ui.find("##pane0", {"Take a scope"});
  ASSERT_GT(at.x, 200);
  EXPECT_TRUE(ui.click_for_views(at).take_scope);
  ui.model.views.panes[0].offers_scope = false;
  EXPECT_LT(ui.find("##pane0", {"Take a scope"}).x, 0);
}

TEST(PanelViews, TheFilmButtonTellsTimeAndSizeAndTheSecondWindowsViewIsChosen) {
  UiFrame ui;
  fill(ui);
  EXPECT_TRUE(ui.click_for_views(ui.find("##top", {"###film"})).toggle_film);
  ui.model.views.film = {true, false, 75, 3.14, "/tmp/a.webm"};
  EXPECT_EQ(film_label(ui.model.views.film), "Stop  1:15  3.1 MB");
  ui.model.views.film.ending = true;
  EXPECT_FALSE(ui.click_for_views(ui.find("##top", {"###film"})).toggle_film);
}

// Presses a slider a little right of its left end; nothing where there is none.
ViewsRequests press_slider(UiFrame& ui, const char* slider) {
  const ImVec2 at = ui.find("##case", {slider});
  if (at.x < 0) return {};
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {at.x + 20, at.y};
  ui.draw();
  io.MouseDown[0] = true;
  const UiRequests pressed = ui.draw();
  io.MouseDown[0] = false;
  ui.draw();
  return pressed.views;
}
std::optional<WaterSettings> press_water(UiFrame& ui, const char* slider) {
  return press_slider(ui, slider).water;
}

TEST(ViewsPanel, TheWaterIsSetWhereAScopeIsOnShow) {
  UiFrame ui;
  fill(ui);
  EXPECT_FALSE(press_water(ui, "##Pump"));
  ui.model.views.water = WaterModel{{8000, 0.25}, 6000, 0.1};
  const auto pumped = press_water(ui, "##Pump");
  ASSERT_TRUE(pumped);
  EXPECT_GT(pumped->pump_pa, 0);
  EXPECT_NE(pumped->pump_pa, 8000);
  EXPECT_NEAR(pumped->outlet_open, 0.25, 1e-12);
  const auto opened = press_water(ui, "##Outlet");
  ASSERT_TRUE(opened);
  EXPECT_NE(opened->outlet_open, 0.25);
  EXPECT_NEAR(opened->pump_pa, 8000, 1e-9);
  ui.model.exercise.page = ExercisePage::kRunning;
  ui.draw();
  EXPECT_FALSE(press_water(ui, "##Pump")) << "the exercise's card has it";
}

TEST(ViewsPanel, TheCameraIsBalancedToItsLightAndKeepsStillsWhereAScopeIsOnShow) {
  UiFrame ui;
  fill(ui);
  EXPECT_FALSE(ui.press_key('C').views.keep_still);
  EXPECT_LT(ui.find("##case", {"Still"}).x, 0);
  ui.model.views.scope_camera = ScopeCameraModel{};
  EXPECT_TRUE(ui.press_key('C').views.keep_still);
  EXPECT_TRUE(ui.click_for_views(ui.find("##case", {"Still"})).keep_still);
  EXPECT_FALSE(ui.click_for_views(ui.find("##case", {"White balance"})).white_balance)
      << "it is balanced";
  const auto lamp = press_slider(ui, "##Light source").white_balance;
  ASSERT_TRUE(lamp);
  EXPECT_NE(lamp->light_k, kScopeLamp_k);
  EXPECT_EQ(lamp->balance_k, kScopeLamp_k) << "the light alone";
  ui.model.views.scope_camera->white = *lamp;
  const auto balanced = ui.click_for_views(ui.find("##case", {"White balance"})).white_balance;
  ASSERT_TRUE(balanced);
  EXPECT_EQ(balanced->balance_k, lamp->light_k);
  ui.model.views.scope_camera->looks = false;
  EXPECT_FALSE(ui.click_for_views(ui.find("##case", {"Still"})).keep_still);
}

TEST(ViewsPanel, TheVolumeIsSetUnlessNothingCanBeHeard) {
  UiFrame ui;
  fill(ui);
  ui.model.views.sound = {0.9, ""};
  const auto set = press_slider(ui, "##Sound").sound_volume;
  ASSERT_TRUE(set);
  EXPECT_GT(*set, 0);
  EXPECT_LT(*set, 0.9);
  ui.model.views.sound.problem = "OpenAL was not found";
  EXPECT_FALSE(press_slider(ui, "##Sound").sound_volume);
}

}  // namespace
}  // namespace osteon
