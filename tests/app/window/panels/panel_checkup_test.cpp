#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include "app/ui/ui_frame.h"

namespace osteon {
namespace {

using test::UiFrame;

class CheckupPanel : public ::testing::Test {
 protected:
  CheckupPanel() {
    UiModel model = test::small_model();
    model.width = ui.model.width;
    model.height = ui.model.height;
    model.checkup.open = true;
    model.checkup.findings = {{FindingLevel::kGood, "Loop", "1000 ticks a second", ""},
                              {FindingLevel::kNote, "USB", "no udev rule", "Install it"},
                              {FindingLevel::kBad, "Device", "is silent", "Plug it in again"}};
    model.checkup.verdict = "Not ready: fix what is marked BAD first.";
    ui.model = std::move(model);
    for (int i = 0; i < 4; ++i) ui.draw();  // until the list has found its height
  }
  UiFrame ui;
  CheckupModel& checkup = ui.model.checkup;
};

TEST_F(CheckupPanel, IsShownOnlyWhenOpenAndWithACase) {
  checkup.open = false;
  ui.draw();
  ui.draw();
  EXPECT_FALSE(ui.shown("##checkup"));
  checkup.open = true;
  ui.draw();
  ui.draw();
  EXPECT_TRUE(ui.shown("##checkup"));
  ui.model.phase = UiPhase::kLoading;
  ui.draw();
  ui.draw();
  EXPECT_FALSE(ui.shown("##checkup"));
}

TEST_F(CheckupPanel, OpensByKeyAndClosesByButton) {
  EXPECT_TRUE(ui.press_key(GLFW_KEY_F2).toggle_checkup);
  EXPECT_TRUE(ui.click("##checkup", {"Close  (F2)"}).toggle_checkup);
}

TEST_F(CheckupPanel, BeforeTheFirstResultItOffersOneAndCopiesNothing) {
  checkup.findings.clear();
  checkup.verdict.clear();
  EXPECT_TRUE(ui.click("##checkup", {"Check again"}).begin_checkup);
  EXPECT_FALSE(ui.click("##checkup", {"Copy the list"}).copy);
}

TEST_F(CheckupPanel, TheListIsCopiedWithItsVerdict) {
  const auto copied = ui.click("##checkup", {"Copy the list"}).copy;
  ASSERT_TRUE(copied);
  EXPECT_NE(copied->find("BAD   Device"), std::string::npos) << *copied;
  EXPECT_NE(copied->find("-> Plug it in again"), std::string::npos);
  EXPECT_NE(copied->find(checkup.verdict), std::string::npos);
}

TEST_F(CheckupPanel, ThePushIsOfferedForADeviceWithMotorsAloneAndNotInBetween) {
  EXPECT_LT(ui.find("##checkup", {"Push gently"}).x, 0);
  checkup.device = "Touch";
  EXPECT_TRUE(ui.click("##checkup", {"Push gently"}).begin_push_test);
  checkup.not_now = "Stop the recording first.";
  EXPECT_FALSE(ui.click("##checkup", {"Push gently"}).begin_push_test);
  EXPECT_FALSE(ui.click("##checkup", {"Check again"}).begin_checkup);
}

TEST_F(CheckupPanel, WhileItRunsItCanOnlyBeStopped) {
  checkup.device = "Touch";
  checkup.running = true;
  checkup.doing = "The device pushes gently";
  EXPECT_LT(ui.find("##checkup", {"Push gently"}).x, 0);
  EXPECT_LT(ui.find("##checkup", {"Check again"}).x, 0);
  EXPECT_TRUE(ui.click("##checkup", {"Stop  (Esc)"}).cancel_checkup);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_ESCAPE).force_off);
}

constexpr const char* kRule = "udev rule: lets users other than root open the devices";

TEST_F(CheckupPanel, TheUdevRuleIsCopiedAndInstalledWhereThatIsAllowed) {
  EXPECT_LT(ui.find("##checkup", {kRule}).x, 0);  // there is none
  checkup.udev.text = "SUBSYSTEM==...";
  ui.click("##checkup", {kRule});
  EXPECT_EQ(ui.click("##checkup", {"Copy the rule"}).copy, checkup.udev.text);
  EXPECT_LT(ui.find("##checkup", {"Install it"}).x, 0);
  const auto command = ui.click("##checkup", {"Copy the command that installs it"}).copy;
  ASSERT_TRUE(command);
  EXPECT_NE(command->find("sudo osteon doctor --install-udev"), std::string::npos);
  checkup.udev.may_install = true;
  EXPECT_TRUE(ui.click("##checkup", {"Install it"}).install_udev);
  checkup.udev.installed = true;
  EXPECT_LT(ui.find("##checkup", {kRule}).x, 0);
}

TEST_F(CheckupPanel, ALongListStaysInsideTheWindowAndScrollsBetweenVerdictAndButtons) {
  for (int i = 0; i < 60; ++i)
    checkup.findings.push_back({FindingLevel::kNote, "phantom", std::string(300, 'x'), "do it"});
  for (int i = 0; i < 4; ++i) ui.draw();
  const UiRect r = ui.rect("##checkup");
  EXPECT_GE(r.x, 0);
  EXPECT_GE(r.y, 0);
  EXPECT_LE(r.right(), ui.model.width);
  EXPECT_LE(r.bottom(), ui.model.height);
  // In reach without a turn of the wheel.
  EXPECT_TRUE(ui.click("##checkup", {"Close  (F2)"}).toggle_checkup);
}

TEST_F(CheckupPanel, AShortListIsShownWhole) {
  for (int i = 0; i < 4; ++i) ui.draw();
  const float before = ui.rect("##checkup").h;
  checkup.findings.push_back({FindingLevel::kGood, "OpenGL", "4.6", ""});
  for (int i = 0; i < 4; ++i) ui.draw();
  EXPECT_GT(ui.rect("##checkup").h, before);
}

TEST_F(CheckupPanel, TheDeviceSectionHasItsButton) {
  checkup.open = false;
  ui.model.hand.info.peak_force_n = 8;
  EXPECT_TRUE(ui.click("##hand", {"Check-up"}).toggle_checkup);
}

}  // namespace
}  // namespace osteon
