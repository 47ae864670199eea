#include "window/panels/panels.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <vector>

#include "app/ui/ui_frame.h"
#include "runs/hands/device_choices.h"
#include "ui/ui_widgets.h"

namespace osteon {
namespace {

using test::small_model;
using test::UiFrame;

void fill(UiFrame& ui, UiModel model) {
  model.width = ui.model.width;
  model.height = ui.model.height;
  ui.model = std::move(model);
}

float area(const UiRect& r) { return r.w * r.h; }

TEST(Panels, NothingIsAskedForWhenNobodyActs) {
  UiFrame ui;
  fill(ui, small_model());
  for (int i = 0; i < 3; ++i) {
    const UiRequests r = ui.draw();
    EXPECT_FALSE(r.view || r.preset || r.device || r.seek_s || r.speed || r.browser.open);
    EXPECT_FALSE(r.force_off || r.force_on || r.toggle_record || r.toggle_panels || r.toggle_help);
    EXPECT_TRUE(r.commands.empty());
  }
}

TEST(Panels, ABoneIsFeltAsChosenInItsPopup) {
  UiFrame ui;
  fill(ui, small_model());
  ui.click("##case", {1, "##swatch"});
  ui.draw();
  const std::string popup = ui.popup();
  ASSERT_FALSE(popup.empty());
  EXPECT_FALSE(ui.click(popup.c_str(), {"Pieces"}).felt) << "it is so already";
  const UiRequests r = ui.click(popup.c_str(), {"Field"});
  ASSERT_TRUE(r.felt);
  EXPECT_EQ(r.felt->bone, BoneId{1});
  EXPECT_EQ(r.felt->felt, Felt::kField);
  const UiRequests covered = ui.click(popup.c_str(), {"Cartilage"});
  ASSERT_TRUE(covered.felt);
  EXPECT_EQ(covered.felt->felt, Felt::kCovered);
  ui.model.record.on = true;
  EXPECT_FALSE(ui.click(popup.c_str(), {"Hull"}).felt) << "while a recording runs";
}

TEST(Panels, AnOpenBoneIsFeltAsItsHullAndInNoOtherWay) {
  UiFrame ui;
  fill(ui, small_model());
  ui.model.bone_open = {false, true, false};
  ui.click("##case", {1, "##swatch"});
  ui.draw();
  const std::string popup = ui.popup();
  ASSERT_FALSE(popup.empty());
  EXPECT_FALSE(ui.click(popup.c_str(), {"Field"}).felt);
  EXPECT_FALSE(ui.click(popup.c_str(), {"Hull"}).felt);
}

UiModel model_with_soft_parts() {
  UiModel model = small_model();
  model.soft_labels = {"Disc", "Triangular fibrocartilage of the wrist", "Skin"};
  model.view.softs.resize(3);
  for (BoneAppearance& look : model.view.softs) look.visible = false;
  model.view.softs[2].opacity = 0.25f;
  return model;
}

TEST(Panels, SoftPartsAreShownOneByOneOrAllButForTheSkin) {
  UiFrame ui;
  fill(ui, model_with_soft_parts());
  EXPECT_LT(ui.find("##case", {"soft", 0, "eye"}).x, 0) << "folded at first";
  ui.click("##case", {"Soft parts"});
  const UiRequests one = ui.click("##case", {"soft", 1, "eye"});
  ASSERT_TRUE(one.view);
  EXPECT_FALSE(one.view->softs[0].visible);
  EXPECT_TRUE(one.view->softs[1].visible);
  EXPECT_TRUE(one.view->bones[1].visible) << "the bone of the same number stays";
  const UiRequests all = ui.click("##case", {"soft", "###all"});
  ASSERT_TRUE(all.view);
  EXPECT_TRUE(all.view->softs[0].visible);
  EXPECT_TRUE(all.view->softs[1].visible);
  EXPECT_FALSE(all.view->softs[2].visible);
}

TEST(Panels, ALongNameIsCutToItsPlace) {
  UiFrame ui;
  ui.draw();
  EXPECT_EQ(ui::shortened("Disc", 1000), "Disc");
  EXPECT_EQ(ui::shortened("", 0), "");
  const std::string cut = ui::shortened("Triangular fibrocartilage", 80);
  EXPECT_TRUE(cut.ends_with("...")) << cut;
  EXPECT_LE(ImGui::CalcTextSize(cut.c_str()).x, 80);
}

TEST(Panels, TheLegendStandsWhereBonesAreColouredByWhatIsFelt) {
  UiFrame ui;
  fill(ui, small_model());
  ui.draw();
  EXPECT_FALSE(ui.shown("##felt_legend"));
  ui.model.view.show_felt = true;
  for (int i = 0; i < 3; ++i) ui.draw();
  ASSERT_TRUE(ui.shown("##felt_legend"));
  const UiRect legend = ui.rect("##felt_legend"), bar = ui.rect("##timeline");
  EXPECT_LE(legend.bottom(), bar.y);
  EXPECT_GT(legend.x, ui.rect("##case").right());
  EXPECT_LT(legend.right(), ui.rect("##hand").x);
  ui.model.felt_measured = 0.5;  // its progress takes the scale's place
  for (int i = 0; i < 3; ++i) ui.draw();
  EXPECT_LT(ui.rect("##felt_legend").h, legend.h);
}

TEST(Panels, TheLegendOfTemperaturesStandsOverTheOther) {
  UiFrame ui;
  fill(ui, small_model());
  ui.draw();
  EXPECT_FALSE(ui.shown("##heat_legend"));
  ui.model.view.show_heat = ui.model.view.show_felt = true;
  for (int i = 0; i < 3; ++i) ui.draw();
  ASSERT_TRUE(ui.shown("##heat_legend"));
  EXPECT_LE(ui.rect("##heat_legend").bottom(), ui.rect("##felt_legend").y);
  EXPECT_GT(ui.rect("##heat_legend").x, ui.rect("##case").right());
}

TEST(Panels, DrawsWithNoBonesAndNoDevice) {
  UiFrame ui;
  ui.model.hand.devices.clear();
  ui.model.hand.device = -1;
  ui.draw();
  ui.draw();
  EXPECT_TRUE(ui.shown("##case"));
  EXPECT_TRUE(ui.shown("##hand"));
}

// The whole built-in wrist, a device with motors, contacts and a warning: the fullest usual cards.
UiModel full_model(std::vector<ContactRow>& contacts) {
  UiModel model = small_model();
  model.bone_labels.clear();
  for (int i = 0; i < 15; ++i) model.bone_labels.push_back("Metacarpal " + std::to_string(i));
  model.view.bones.resize(15);
  contacts = {{BoneId{0}, 1.0, 0.2, false}};
  model.contacts = contacts;
  model.hand.realtime_warning = "no priority";
  model.hand.info.peak_force_n = 8;
  return model;
}

TEST(Panels, ThePictureIsTwoThirdsOfTheWindow) {
  for (const ImVec2 size : {ImVec2(1280, 720), ImVec2(1920, 1080), ImVec2(2560, 1440)}) {
    UiFrame ui(size.x, size.y);
    std::vector<ContactRow> contacts;
    fill(ui, full_model(contacts));
    for (int i = 0; i < 4; ++i) ui.draw();
    const float covered = area(ui.rect("##top")) + area(ui.rect("##timeline")) +
                          area(ui.rect("##case")) + area(ui.rect("##hand"));
    EXPECT_GT(covered, 0);
    EXPECT_LT(covered, size.x * size.y / 3) << size.x << " x " << size.y;
  }
}

TEST(Panels, CardsStayInsideTheWindowAndApart) {
  for (const ImVec2 size : {ImVec2(640, 400), ImVec2(1280, 720), ImVec2(2560, 1440)}) {
    UiFrame ui(size.x, size.y);
    std::vector<ContactRow> contacts;
    fill(ui, full_model(contacts));
    for (int i = 0; i < 4; ++i) ui.draw();
    const UiRect left = ui.rect("##case"), right = ui.rect("##hand");
    EXPECT_LT(left.right(), right.x);
    EXPECT_LE(right.right(), size.x);
    EXPECT_LE(left.bottom(), ui.rect("##timeline").y);
    EXPECT_LE(right.bottom(), ui.rect("##timeline").y);
    EXPECT_GE(left.y, ui.rect("##top").bottom());
  }
}

TEST(Panels, TheLeftCardOfAWristNeedsNoScrollingAtTheUsualSize) {
  UiFrame ui(1280, 720);
  std::vector<ContactRow> contacts;
  fill(ui, full_model(contacts));
  for (int i = 0; i < 4; ++i) ui.draw();
  EXPECT_EQ(ImGui::FindWindowByName("##case")->ScrollMax.y, 0);
}

TEST(Panels, HintsStayBetweenTheCardsHoweverNarrowTheWindow) {
  for (const float width : {800.0f, 1280.0f}) {
    UiFrame ui(width, width == 800 ? 600 : 720);
    const float height = ui.model.height;
    ui.model = test::small_model();
    ui.model.width = width;
    ui.model.height = height;
    ui.model.first_run_hint = true;
    for (const char* note : {"##hint", "##probe"}) {
      ui.model.hand.probe_in_hand = note == std::string("##probe");
      for (int i = 0; i < 3; ++i) ui.draw();
      const UiRect hint = ui.rect(note);
      const UiLayout layout = make_layout(width, height, 1, true);
      ASSERT_GT(hint.w, 0) << note;
      EXPECT_GE(hint.x, layout.left.right()) << note << " " << width;
      EXPECT_LE(hint.right(), layout.right.x) << note << " " << width;
      EXPECT_LE(hint.bottom(), layout.picture.bottom()) << note << " " << width;
    }
    ui.model.hand.probe_in_hand = false;
    EXPECT_TRUE(ui.click("##hint", {"Got it"}).dismiss_hint) << width;
  }
}

TEST(Panels, WhatRunsInTheHandTellsItsKey) {
  UiFrame ui;
  fill(ui, small_model());
  ui.model.hand.probe_in_hand = true;
  HandRow other, active;
  other.key_does = "shut (hold)";
  active.active = true;
  ui.model.hands.rows = {other, active};
  const auto width = [&] {
    for (int i = 0; i < 3; ++i) ui.draw();
    return ui.rect("##probe").w;
  };
  const float without = width();
  ui.model.hands.rows[1].key_does = "run (hold)";
  EXPECT_GT(width(), without + 10);
}

// Their keys move the outside view; over another layout's small views they would be in the way.
TEST(Panels, TheFirstHintIsShownOverTheOutsideViewAlone) {
  UiFrame ui;
  fill(ui, small_model());
  ui.model.first_run_hint = true;
  for (std::size_t i = 0; i < kPictureLayouts; ++i) {
    ui.model.views.layout = static_cast<PictureLayout>(i);
    for (int k = 0; k < 3; ++k) ui.draw();
    EXPECT_EQ(ui.shown("##hint"), ui.model.views.layout == PictureLayout::kOutside)
        << title_of(ui.model.views.layout);
  }
}

TEST(Panels, OpensWithOAloneAndWithCtrlAsElsewhere) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_TRUE(ui.press_key(GLFW_KEY_O).browser.toggle);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_O, false, true).browser.toggle);
}

TEST(Panels, TabAsksToFoldAndFoldedShowsThePictureAlone) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_TRUE(ui.press_key(GLFW_KEY_TAB).toggle_panels);
  ui.model.panels_open = false;
  ui.draw();
  ui.draw();
  for (const char* name : {"##top", "##case", "##hand", "##timeline"})
    EXPECT_FALSE(ui.shown(name)) << name;
  EXPECT_TRUE(ui.press_key(GLFW_KEY_TAB).toggle_panels);
}

TEST(Panels, AClickOnAnEyeHidesThatBoneOnly) {
  UiFrame ui;
  fill(ui, small_model());
  const UiRequests r = ui.click("##case", {1, "eye"});
  ASSERT_TRUE(r.view);
  EXPECT_TRUE(r.view->bones[0].visible);
  EXPECT_FALSE(r.view->bones[1].visible);
  EXPECT_TRUE(r.view->bones[2].visible);
}

TEST(Panels, AClickOnANamePicksTheBone) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_EQ(ui.click("##case", {2, "Capitate"}).picked_row, BoneId{2});
}

TEST(Panels, EveryPresetHasAButtonAndAKey) {
  const std::vector<std::pair<const char*, ViewPreset>> presets = {
      {"Dorsal", ViewPreset::kDorsal}, {"Palmar", ViewPreset::kPalmar},
      {"Radial", ViewPreset::kRadial}, {"Ulnar", ViewPreset::kUlnar},
      {"PA", ViewPreset::kAp},         {"Lateral", ViewPreset::kLateral}};
  UiFrame ui;
  fill(ui, small_model());
  for (std::size_t i = 0; i < presets.size(); ++i) {
    const UiRequests clicked = ui.click("##case", {presets[i].first});
    ASSERT_TRUE(clicked.preset) << presets[i].first;
    EXPECT_EQ(*clicked.preset, presets[i].second);
    const UiRequests pressed = ui.press_key(GLFW_KEY_1 + static_cast<int>(i));
    ASSERT_TRUE(pressed.preset);
    EXPECT_EQ(*pressed.preset, presets[i].second);
  }
}

TEST(Panels, AKneesViewsHaveItsOwnNames) {
  UiFrame ui;
  fill(ui, small_model());
  ui.model.is_knee = true;
  const UiRequests clicked = ui.click("##case", {"Lateral"});
  ASSERT_TRUE(clicked.preset);
  EXPECT_EQ(*clicked.preset, ViewPreset::kRadial);
}

TEST(Panels, TheStiffnessSliderSendsACommandWithinTheDevicesLimit) {
  UiFrame ui;
  fill(ui, small_model());
  ui.model.hand.stiffness_max_n_per_m = 1500;
  const ImVec2 at = ui.find("##hand", {"##Stiffness"});
  ASSERT_GE(at.x, 0);
  const UiRect card = ui.rect("##hand");
  const UiRequests r = ui.click({card.right() - 12, at.y});
  ASSERT_EQ(r.commands.size(), 1u);
  EXPECT_EQ(r.commands[0].kind, CommandKind::kSetStiffness);
  EXPECT_GT(r.commands[0].value, 1400);
  EXPECT_LE(r.commands[0].value, 1500);
}

TEST(Panels, LettingBonesMoveIsACommand) {
  UiFrame ui;
  fill(ui, small_model());
  const UiRequests r = ui.click("##hand", {"Bones held still"});
  ASSERT_EQ(r.commands.size(), 1u);
  EXPECT_EQ(r.commands[0].kind, CommandKind::kHoldBones);
  EXPECT_EQ(r.commands[0].value, 0);
}

TEST(Panels, EscapeSwitchesTheForceOffEvenWhileLoading) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_TRUE(ui.press_key(GLFW_KEY_ESCAPE).force_off);
  ui.model.phase = UiPhase::kLoading;
  EXPECT_TRUE(ui.press_key(GLFW_KEY_ESCAPE).force_off);
}

TEST(Panels, AForceThatIsOffCanBeResumedByButtonAndKey) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_FALSE(ui.press_key(GLFW_KEY_ENTER).force_on);
  EXPECT_LT(ui.find("##hand", {"Resume"}).x, 0);
  ui.model.hand.status.cause = ForceOff::kDisconnect;
  EXPECT_TRUE(ui.click("##hand", {"Resume"}).force_on);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_ENTER).force_on);
}

TEST(Panels, TheDeviceCannotBeChangedWhileRecording) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_GE(ui.find("##hand", {"##device"}).x, 0);
  ui.model.record.on = true;
  ui.click("##hand", {"##device"});
  ui.draw();
  EXPECT_EQ(ImGui::GetCurrentContext()->OpenPopupStack.Size, 0);
}

TEST(Panels, RecordIsAskedForByButtonAndKeyButNotInAReplay) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_TRUE(ui.click("##top", {"###record"}).toggle_record);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_R).toggle_record);
  ui.model.replay.on = true;
  ui.model.replay.duration_s = 10;
  EXPECT_FALSE(ui.click("##top", {"###record"}).toggle_record);
  EXPECT_FALSE(ui.press_key(GLFW_KEY_R).toggle_record);
}

TEST(Panels, AReplayIsScrubbedOnTheTimeline) {
  UiFrame ui;
  fill(ui, small_model());
  const ImVec2 live = ui.find("##timeline", {"lane"});
  EXPECT_FALSE(ui.click(live).seek_s);
  ui.model.replay.on = true;
  ui.model.replay.duration_s = 20;
  const UiRect bar = ui.rect("##timeline");
  const UiRequests end = ui.click({bar.right() - 17, live.y + 8});
  ASSERT_TRUE(end.seek_s);
  EXPECT_NEAR(*end.seek_s, 20, 0.1);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_P).toggle_play);
  const UiRequests faster = ui.press_key(GLFW_KEY_PERIOD);
  ASSERT_TRUE(faster.speed);
  EXPECT_EQ(*faster.speed, 2);
}

TEST(Panels, SpeedKeysStayWithinTheirRange) {
  UiFrame ui;
  fill(ui, small_model());
  ui.model.replay.on = true;
  ui.model.replay.duration_s = 5;
  ui.model.replay.speed = 4;
  EXPECT_EQ(*ui.press_key(GLFW_KEY_PERIOD).speed, 4);
  ui.model.replay.speed = 0.1;
  EXPECT_EQ(*ui.press_key(GLFW_KEY_COMMA).speed, 0.1);
}

TEST(Panels, LoadingShowsProgressAndCanBeCancelled) {
  UiFrame ui;
  fill(ui, small_model());
  ui.model.phase = UiPhase::kLoading;
  ui.model.loading = {"Opening the bones", 0.4, 3, {}, true};
  EXPECT_TRUE(ui.click("##loading", {"Cancel"}).cancel_loading);
  EXPECT_FALSE(ui.shown("##case"));
  ui.model.phase = UiPhase::kFailed;
  ui.model.loading.failure = "The case folder is not there.";
  EXPECT_TRUE(ui.click("##loading", {"Open the built-in wrist"}).retry_loading);
}

TEST(Panels, QuittingTakesCtrlAndTheLetterAloneDoesNot) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_FALSE(ui.press_key(GLFW_KEY_Q).quit);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_Q, false, true).quit);
}

TEST(Panels, ErrorsStayUntilClosed) {
  UiFrame ui;
  fill(ui, small_model());
  const std::vector<Toast> toasts = {{7, ToastKind::kError, "The disk is full.", 0}};
  ui.model.toasts = toasts;
  const UiRequests r = ui.click("##toast7", {"Close"});
  ASSERT_TRUE(r.dismiss_toast);
  EXPECT_EQ(*r.dismiss_toast, 7u);
}

TEST(Panels, NoMessageLiesUnderTheButtonThatBeginsAnEdit) {
  for (const ImVec2 size : {ImVec2(800, 600), ImVec2(1280, 720)}) {
    UiFrame ui(size.x, size.y);
    fill(ui, small_model());
    ui.model.edit.can_begin = true;
    const std::vector<Toast> toasts = {{7, ToastKind::kError,
                                        "This computer was too busy for a moment: a device with "
                                        "motors would have switched its force off.",
                                        0}};
    ui.model.toasts = toasts;
    for (int i = 0; i < 3; ++i) ui.draw();
    const UiRect edit = ui.rect("##edit"), toast = ui.rect("##toast7");
    ASSERT_GT(edit.w, 0);
    ASSERT_GT(toast.w, 0);
    EXPECT_TRUE(edit.right() <= toast.x || edit.bottom() <= toast.y) << size.x;
  }
}

TEST(Panels, PictureKeysDoNotActWhileTheProbeIsTurnedByKeys) {
  UiFrame ui;
  fill(ui, small_model());
  ui.model.hand.probe_in_hand = true;
  EXPECT_FALSE(ui.press_key(GLFW_KEY_1).preset);
  EXPECT_TRUE(ui.press_key(GLFW_KEY_M).toggle_probe);
}

TEST(Panels, TheHelpNamesEveryKeyThatActs) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_TRUE(ui.press_key(GLFW_KEY_F1).toggle_help);
  ui.model.help_open = true;
  ui.draw();
  ui.draw();
  const UiRect help = ui.rect("##help");
  EXPECT_GT(help.h, 0);
  EXPECT_LE(help.bottom(), ui.model.height);
  EXPECT_GE(help.y, 0);
  EXPECT_TRUE(ui.click("##help", {"Close  (F1)"}).toggle_help);
}

TEST(Panels, DigitsAreAllEquallyWide) {
  UiFrame ui;
  for (const ImFont* font : {ui.fonts().body, ui.fonts().small, ui.fonts().large})
    for (ImWchar c = '1'; c <= '9'; ++c)
      EXPECT_EQ(font->GetCharAdvance(c), font->GetCharAdvance('0'));
}

UiModel model_with_device() {
  UiModel model = small_model();
  model.hand.info.peak_force_n = 8;
  model.hand.probe_by_mouse = false;
  model.hand.mapping.settable = true;
  return model;
}

TEST(DevicePanel, OnlyADeviceWithMotorsHasOne) {
  UiFrame ui;
  fill(ui, small_model());
  EXPECT_LT(ui.find("##hand", {"Mapping"}).x, 0);
  fill(ui, model_with_device());
  EXPECT_GT(ui.find("##hand", {"Mapping"}).x, 0);
  EXPECT_LT(ui.find("##hand", {"Calibrate"}).x, 0);
}

TEST(DevicePanel, CalibrationIsOfferedWhereItIsNeeded) {
  UiFrame ui;
  fill(ui, model_with_device());
  ui.model.hand.status.health.calibration = Calibration::kNeeded;
  ui.model.hand.status.health.advice = "Move the stylus into the inkwell";
  const ImVec2 at = ui.find("##hand", {"Calibrate"});
  ASSERT_GT(at.x, 0);
  EXPECT_TRUE(ui.click(at).calibrate);
  ui.model.hand.status.health.calibration = Calibration::kRunning;
  EXPECT_LT(ui.find("##hand", {"Calibrate"}).x, 0);
}

// Two arms of one make have the same name until their serial numbers tell them apart.
TEST(DevicePanel, OfTwoDevicesOfOneNameTheSecondCanBeChosen) {
  UiFrame ui;
  fill(ui, model_with_device());
  ui.model.hand.devices = {"Arm", "Arm"};
  ui.click("##hand", {"##device"});
  ui.draw();
  const UiRequests r = ui.click("##Combo_00", {1, "Arm"});
  ASSERT_TRUE(r.device);
  EXPECT_EQ(*r.device, 1);
}

TEST(DeviceChoices, AreToldApartBySerialNumber) {
  DeviceInfo left, right;
  left.serial = "Left Device";
  right.serial = "Right Device";
  const std::vector<DeviceChoice> choices = {
      {"Mouse", "mouse", {}}, {"Arm", "phantom", left}, {"Arm", "phantom", right}};
  EXPECT_EQ(key_of(choices[0]), "mouse");
  EXPECT_EQ(find_choice(choices, key_of(choices[2])), 2);
  EXPECT_EQ(find_choice(choices, "phantom"), 1);
  EXPECT_EQ(find_choice(choices, "phantom:unplugged"), 1);
  EXPECT_EQ(find_choice(choices, "falcon"), 0);
  EXPECT_EQ(find_choice({}, "falcon"), 0);
}

TEST(DevicePanel, DrawsEveryStateOfADeviceInsideTheWindow) {
  for (const ImVec2 size : {ImVec2(640, 400), ImVec2(1280, 720)}) {
    UiFrame ui(size.x, size.y);
    fill(ui, model_with_device());
    HandModel& hand = ui.model.hand;
    hand.has_dead_man = true;
    hand.dead_man_held = false;
    hand.status.clutched = true;
    hand.status.health = {
        Calibration::kNeeded, "Put the stylus into the inkwell", 0.9, 100, 100, 0, 3};
    hand.status.safety.passivity = {-0.002, 4, 0.5, 2};
    hand.status.cause = ForceOff::kTemperature;
    for (int k = 0; k < 4; ++k) ui.draw();
    EXPECT_LE(ui.rect("##hand").bottom(), size.y);
  }
}

}  // namespace
}  // namespace osteon
