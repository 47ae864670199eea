#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/ui/ui_frame.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

using test::small_model;
using test::UiFrame;

void fill(UiFrame& ui, int shots) {
  UiModel model = small_model();
  model.width = ui.model.width;
  model.height = ui.model.height;
  model.views.layout = PictureLayout::kFluoro;
  model.views.can_shoot = true;
  model.views.panes = {{{PaneKind::kFluoro, {200, 60, 800, 560}, true}, "", false}};
  for (int k = 1; k <= shots; ++k) {
    ShotModel shot;
    shot.number = k;
    model.views.xray.shots.push_back(shot);
  }
  model.views.xray.shown = static_cast<std::size_t>(std::max(shots - 1, 0));
  model.views.xray.total.dose.shots = shots;
  ui.model = std::move(model);
}

TEST(PanelXray, TheDeskTakesAPictureUnlessOneIsBeingMade) {
  UiFrame ui;
  fill(ui, 0);
  const ImVec2 at = ui.find("##xray", {"###shoot"});
  ASSERT_GT(at.x, 200);
  EXPECT_TRUE(ui.click_for_views(at).shoot);
  ui.model.views.can_shoot = false;
  EXPECT_FALSE(ui.click_for_views(at).shoot);
}

TEST(PanelXray, TheArmIsTurnedByButtonsAndSliders) {
  UiFrame ui;
  fill(ui, 0);
  const auto side = ui.click_for_views(ui.find("##xray", {"Lateral"})).xray.turn;
  ASSERT_TRUE(side);
  EXPECT_EQ(*side, (CArmTurn{90, 0}));
  ui.model.views.xray.turn = {20, -10};
  ui.model.is_knee = true;
  const auto front = ui.click_for_views(ui.find("##xray", {"AP"})).xray.turn;
  ASSERT_TRUE(front);
  EXPECT_EQ(*front, CArmTurn{});
  ImGuiIO& io = ImGui::GetIO();
  const ImVec2 orbit = ui.find("##xray", {"##Orbit"});
  io.MousePos = {orbit.x + 30, orbit.y};
  ui.draw();
  io.MouseDown[0] = true;
  const auto turned = ui.draw().views.xray.turn;
  io.MouseDown[0] = false;
  ui.draw();
  ASSERT_TRUE(turned);
  EXPECT_NE(turned->orbit_deg, 20);
  EXPECT_EQ(turned->orbit_deg, std::round(turned->orbit_deg)) << "whole degrees";
  EXPECT_EQ(turned->tilt_deg, -10);
}

TEST(PanelXray, AnEarlierPictureIsChosenAndAnExaminationBeginsAnew) {
  UiFrame ui;
  fill(ui, 0);
  const ImVec2 again = ui.find("##xray", {"New examination"});
  EXPECT_FALSE(ui.click_for_views(again).xray.begin_again) << "nothing to forget";
  fill(ui, 3);
  EXPECT_TRUE(ui.click_for_views(again).xray.begin_again);
  const ImGuiWindow* strip = nullptr;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (std::string(window->Name).find("##xray/strip") == 0) strip = window;
  ASSERT_TRUE(strip);
  // Two in a row, the newest first.
  const ImVec2 lo = strip->InnerRect.Min;
  const float side = strip->InnerRect.GetWidth() / 2;
  EXPECT_EQ(ui.click_for_views({lo.x + side / 2, lo.y + side / 2}).xray.show, 2u);
  EXPECT_EQ(ui.click_for_views({lo.x + 1.5f * side, lo.y + side / 2}).xray.show, 1u);
  EXPECT_EQ(ui.click_for_views({lo.x + side / 2, lo.y + 1.5f * side}).xray.show, 0u);
  EXPECT_FALSE(ui.click_for_views({lo.x + 1.5f * side, lo.y + 1.5f * side}).xray.show);
}

TEST(PanelXray, ASmallPaneHasNoDesk) {
  UiFrame ui;
  fill(ui, 1);
  ui.model.views.panes[0].pane.large = false;
  EXPECT_LT(ui.find("##xray", {"###shoot"}).x, 0);
}

}  // namespace
}  // namespace osteon
