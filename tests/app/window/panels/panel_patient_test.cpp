#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/ui/ui_frame.h"

namespace osteon {
namespace {

using test::UiFrame;

class PatientPanel : public ::testing::Test {
 protected:
  PatientPanel() {
    UiModel model = test::small_model();
    model.width = ui.model.width;
    model.height = ui.model.height;
    ui.model = std::move(model);
    patient().open = true;
    patient().parameters = parameters;
    patient().findings = findings;
    for (int i = 0; i < 4; ++i) ui.draw();
  }
  PatientModel& patient() { return ui.model.patient; }
  // A window's child has a name of its own, which ends with a number.
  std::string form() const {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (std::string(window->Name).starts_with("##patient/form")) return window->Name;
    return {};
  }

  std::vector<VariationParameter> parameters = {
      {"radial_inclination_deg", 24, 3.8, 16, 32, 25.8, "400 films", "slope of the radius"},
      {"size_percent", 100, 5, 88, 112, 100, "statures", "all sizes"}};
  std::vector<AnatomyFinding> findings = {
      {"geissler", "scapholunate gap", "Geissler", {{"1", "none seen"}, {"4", "a gap"}}}};
  UiFrame ui;
};

TEST_F(PatientPanel, IsShownOnlyWhenOpen) {
  EXPECT_TRUE(ui.shown("##patient"));
  patient().open = false;
  ui.draw();
  ui.draw();
  EXPECT_FALSE(ui.shown("##patient"));
}

TEST_F(PatientPanel, TheKeyAndTheButtonCloseIt) {
  EXPECT_TRUE(ui.press_key(GLFW_KEY_N).patient.toggle);
  EXPECT_TRUE(ui.click("##patient", {"Close  (N)"}).patient.toggle);
}

TEST_F(PatientPanel, WithoutTablesItStillStands) {
  patient().parameters = {};
  patient().findings = {};
  EXPECT_FALSE(ui.draw().patient.order);
}

TEST_F(PatientPanel, TheOtherAnatomyAndTheOtherSideAreAsked) {
  const auto knee = ui.click("##patient", {"Knee"}).patient.order;
  ASSERT_TRUE(knee);
  EXPECT_EQ(knee->anatomy, "knee");
  const auto left = ui.click("##patient", {"Left"}).patient.order;
  ASSERT_TRUE(left);
  EXPECT_EQ(left->side, "left");
  EXPECT_FALSE(ui.click("##patient", {"Right"}).patient.order) << "it is that already";
}

TEST_F(PatientPanel, ASliderSetsItsMeasureWithinItsRangeAndResetFreesIt) {
  const auto set =
      ui.click(form().c_str(), {"measures", "radial_inclination_deg", "##Radial inclination"})
          .patient.order;
  ASSERT_TRUE(set);
  ASSERT_EQ(set->set.size(), 1u);
  EXPECT_EQ(set->set[0].first, "radial_inclination_deg");
  EXPECT_GE(set->set[0].second, 16);
  EXPECT_LE(set->set[0].second, 32);
  patient().order = *set;
  const auto freed =
      ui.click(form().c_str(), {"measures", "radial_inclination_deg", "Reset"}).patient.order;
  ASSERT_TRUE(freed);
  EXPECT_TRUE(freed->set.empty());
}

TEST_F(PatientPanel, AnotherPatientHasTheNextNumber) {
  patient().order.seed = 41;
  const auto next = ui.click("##patient", {"Another"}).patient.order;
  ASSERT_TRUE(next);
  EXPECT_EQ(next->seed, 42u);
}

TEST_F(PatientPanel, MakingCanBeStoppedAndNotBegunAgain) {
  EXPECT_TRUE(ui.click("##patient", {"Make and open"}).patient.make);
  patient().making = true;
  EXPECT_TRUE(ui.click("##patient", {"Stop"}).patient.stop);
  EXPECT_FALSE(ui.click("##patient", {"Knee"}).patient.order) << "it would not be what is made";
}

}  // namespace
}  // namespace osteon
