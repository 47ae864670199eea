#include <gtest/gtest.h>

#include "app/ui/ui_frame.h"

namespace osteon {
namespace {

UiModel bendable_model() {
  UiModel model = test::small_model();
  model.joints = {{"Flexion", 0, 0, 130}};
  model.can_bend = true;
  return model;
}

void show(test::UiFrame& ui, UiModel model) {
  model.width = ui.model.width;
  model.height = ui.model.height;
  ui.model = std::move(model);
}

/// Presses the slider where it is found, and lets it go.
std::pair<UiRequests, UiRequests> press_slider(test::UiFrame& ui) {
  const ImVec2 at = ui.find("##case", {"##Flexion"});
  if (at.x < 0) return {};
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {at.x + 60, at.y};
  ui.draw();
  io.MouseDown[0] = true;
  const UiRequests pressed = ui.draw();
  if (pressed.bend) ui.model.joints[0].degrees = pressed.bend->degrees;
  io.MouseDown[0] = false;
  return {pressed, ui.draw()};
}

TEST(PanelJoint, TheSliderBendsAtOnceAndIsDoneWhenLetGo) {
  test::UiFrame ui;
  show(ui, bendable_model());
  const auto [pressed, let_go] = press_slider(ui);
  ASSERT_TRUE(pressed.bend);
  EXPECT_GT(pressed.bend->degrees, 5);
  EXPECT_LE(pressed.bend->degrees, 130);
  EXPECT_FALSE(pressed.bend->done);
  ASSERT_TRUE(let_go.bend);
  EXPECT_TRUE(let_go.bend->done);
  EXPECT_EQ(let_go.bend->degrees, pressed.bend->degrees);
}

TEST(PanelJoint, NothingBendsWhileTheCaseIsNeededAsItIs) {
  test::UiFrame ui;
  UiModel model = bendable_model();
  model.can_bend = false;
  show(ui, std::move(model));
  const auto [pressed, let_go] = press_slider(ui);
  EXPECT_FALSE(pressed.bend || let_go.bend);
}

TEST(PanelJoint, ACaseWithoutAJointHasNoSlider) {
  test::UiFrame ui;
  show(ui, test::small_model());
  EXPECT_LT(ui.find("##case", {"##Flexion"}).x, 0);
}

}  // namespace
}  // namespace osteon
