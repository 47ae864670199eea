#include "segment/segment_panels.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace osteon {
namespace {

/// An ImGui context without a window: draws frames of a model and plays the user.
class SegmentPanels : public ::testing::Test {
 protected:
  SegmentPanels() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {1280, 720};
    fonts_ = load_fonts(1);
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    apply_theme(1);
    GridFrame frame;
    frame.size = {40, 30, 20};
    const auto planes = slice_planes(frame);
    for (std::size_t p = 0; p < 3; ++p) model.panes[p].plane = planes[p];
    model.title = "scan";
    model.out = "my_case";
    model.known_names = {"lunate", "scaphoid"};
  }
  ~SegmentPanels() override { ImGui::DestroyContext(); }

  void add_bones() {
    model.bones = {{1, "lunate", 23712, 900, 0.9, true}, {5, "bone_2", 0, 12, 0.01, true}};
    model.chosen = 5;
  }

  SegmentRequests draw() {
    ImGui::GetIO().DeltaTime = 1.0f / 60;
    ImGui::NewFrame();
    const SegmentRequests requests = draw_segment_ui(model, fonts_);
    ImGui::Render();
    return requests;
  }

  /// Requests of the frame in which the pressed button is let go, over the widget of that name.
  SegmentRequests click(const char* window, const char* label) {
    const ImVec2 at = find(window, label);
    EXPECT_GE(at.x, 0) << label << " is not there";
    if (at.x < 0) return {};
    draw();
    ImGui::GetIO().MouseDown[0] = true;
    draw();
    ImGui::GetIO().MouseDown[0] = false;
    return draw();
  }

  ImVec2 find(const char* window, const char* label) {
    draw();
    draw();
    const ImGuiWindow* found = ImGui::FindWindowByName(window);
    if (!found || !found->WasActive) return {-1, -1};
    const ImGuiID id = ImHashStr(label, 0, found->ID);
    const ImRect area = found->Rect();
    for (float y = area.Min.y + 2; y < area.Max.y; y += 6)
      for (float x = area.Min.x + 6; x < area.Max.x; x += 12) {
        ImGui::GetIO().MousePos = {x, y};
        draw();
        if (ImGui::GetCurrentContext()->HoveredId == id) return {x, y};
      }
    return {-1, -1};
  }

  SegmentRequests press(int key, bool ctrl = false, bool shift = false) {
    ImGuiIO& io = ImGui::GetIO();
    draw();
    io.KeyCtrl = ctrl;
    io.KeyShift = shift;
    io.KeysDown[key] = true;
    const SegmentRequests requests = draw();
    io.KeysDown[key] = false;
    io.KeyCtrl = io.KeyShift = false;
    draw();
    return requests;
  }

  static bool shown(const char* window) {
    const ImGuiWindow* found = ImGui::FindWindowByName(window);
    return found && found->WasActive;
  }

  SegmentModel model;
  UiFonts fonts_;
};

TEST_F(SegmentPanels, LayoutFillsTheWindowWithoutOverlap) {
  for (const bool panels : {true, false})
    for (const float scale : {1.0f, 2.0f}) {
      const SegmentLayout layout = make_segment_layout(1280 * scale, 720 * scale, scale, panels);
      const auto& s = layout.slices;
      EXPECT_LE(s[0].right(), layout.solid.x);
      EXPECT_LE(s[0].bottom(), s[1].y);
      EXPECT_FLOAT_EQ(layout.solid.right(), layout.middle.right());
      EXPECT_FLOAT_EQ(s[2].bottom(), 720 * scale);
      EXPECT_GT(layout.middle.w, 0.6f * 1280 * scale);
    }
  const SegmentLayout tiny = make_segment_layout(300, 60, 2, true);
  for (const UiRect& pane : tiny.slices) EXPECT_GE(pane.w * pane.h, 1);
}

TEST_F(SegmentPanels, WithoutBonesOnlyFindingThemIsOffered) {
  EXPECT_TRUE(click("##bones", "Find the bones").suggest);
  EXPECT_LT(find("##bones", "Find the bones again").x, 0);
  EXPECT_FALSE(click("##bones", "Save as a case").save);
  EXPECT_FALSE(click("##bones", "Undo").undo);
}

TEST_F(SegmentPanels, WithBonesTheyCanBeSavedRemovedAndUndone) {
  add_bones();
  model.undo_steps = 1;
  EXPECT_TRUE(click("##bones", "Save as a case").save);
  EXPECT_EQ(click("##bones", "Remove").remove, 5);
  EXPECT_TRUE(click("##bones", "Undo").undo);
  EXPECT_FALSE(click("##bones", "Redo").redo);
  model.job.emplace().can_cancel = true;
  EXPECT_FALSE(click("##bones", "Save as a case").save) << "while it is being saved";
  EXPECT_TRUE(shown("##job"));
  EXPECT_TRUE(click("##job", "Cancel").cancel_job);
}

TEST_F(SegmentPanels, KeysChooseToolsAndWithCtrlTheyDoNot) {
  const auto tool = press(GLFW_KEY_G).tools;
  ASSERT_TRUE(tool);
  EXPECT_EQ(tool->tool, SegmentTool::kGrow);
  const SegmentRequests save = press(GLFW_KEY_S, true);
  EXPECT_TRUE(save.save);
  EXPECT_FALSE(save.tools);
  EXPECT_TRUE(press(GLFW_KEY_Z, true).undo);
  EXPECT_TRUE(press(GLFW_KEY_Z, true, true).redo);
  EXPECT_TRUE(press(GLFW_KEY_Q, true).quit);
  const auto thicker = press(GLFW_KEY_RIGHT_BRACKET).tools;
  ASSERT_TRUE(thicker);
  EXPECT_GT(thicker->radius_m, model.tools.radius_m);
}

TEST_F(SegmentPanels, ThePointerOverASliceIsToldInItsPixels) {
  const UiRect pane = make_segment_layout(1280, 720, 1, true).slices[2];
  ImGuiIO& io = ImGui::GetIO();
  io.MousePos = {pane.x + 30, pane.y + 40};
  draw();
  draw();
  io.MouseDown[0] = true;
  SegmentRequests requests = draw();
  ASSERT_TRUE(requests.pointer);
  EXPECT_EQ(requests.pointer->pane, 2u);
  EXPECT_DOUBLE_EQ(requests.pointer->x, 30);
  EXPECT_DOUBLE_EQ(requests.pointer->y, 40);
  EXPECT_TRUE(requests.pointer->pressed);
  io.MousePos.x -= 200;  // into another pane: the drag stays this one's
  requests = draw();
  ASSERT_TRUE(requests.pointer);
  EXPECT_EQ(requests.pointer->pane, 2u);
  EXPECT_TRUE(requests.pointer->held);
  EXPECT_FALSE(requests.pointer->pressed);
  io.MouseDown[0] = false;
  requests = draw();
  ASSERT_TRUE(requests.pointer);
  EXPECT_TRUE(requests.pointer->released);
}

TEST_F(SegmentPanels, ThePointerOverACardIsNoneOverASlice) {
  ImGui::GetIO().MousePos = {100, 650};
  draw();
  EXPECT_FALSE(draw().pointer);
}

TEST_F(SegmentPanels, TheQuestionAtTheEndHasThreeAnswersAndHoldsTheKeys) {
  model.asks_to_close = true;
  EXPECT_TRUE(click("##close", "Save").quit_after_saving);
  EXPECT_TRUE(click("##close", "Don't save").quit_without_saving);
  EXPECT_TRUE(click("##close", "Stay").stay);
  EXPECT_FALSE(press(GLFW_KEY_G).tools);
}

TEST_F(SegmentPanels, WhileOpeningAndAfterAFailureNothingElseIsShown) {
  model.phase = UiPhase::kLoading;
  model.loading.can_cancel = true;
  EXPECT_TRUE(click("##loading", "Cancel").cancel_job);
  EXPECT_FALSE(shown("##bones"));
  model.phase = UiPhase::kFailed;
  model.loading.failure = "scan.nrrd: is cut short";
  EXPECT_TRUE(click("##loading", "Close").quit_without_saving);
}

TEST_F(SegmentPanels, TabFoldsTheCardsAway) {
  EXPECT_TRUE(press(GLFW_KEY_TAB).toggle_panels);
  model.panels_open = false;
  draw();
  draw();
  EXPECT_FALSE(shown("##bones"));
  EXPECT_TRUE(shown("Axial"));
}

TEST_F(SegmentPanels, AScanIsChosenBeforeAnythingElseIsShown) {
  model.chooser.emplace();
  ScanFolder& folder = model.chooser->folder;
  folder.path = "/scans/hand";
  folder.entries = {{"left", "/scans/hand/left", true}, {"a.nrrd", "/scans/hand/a.nrrd", false}};
  EXPECT_FALSE(click("##chooser", "###open").open_scan) << "no slices here";
  EXPECT_FALSE(shown("##bones"));
  EXPECT_EQ(click("##chooser", "Up").browse, "/scans");
  folder.dicom_files = 12;
  EXPECT_EQ(click("##chooser", "###open").open_scan, "/scans/hand");
  EXPECT_TRUE(click("##chooser", "Close").quit_without_saving);
  model.returns = true;
  EXPECT_TRUE(click("##chooser", "Back to the simulator").quit_without_saving);
}

TEST_F(SegmentPanels, ASavedCaseCanBeOpenedUntilItChanges) {
  add_bones();
  EXPECT_EQ(find("##bones", "Open in the simulator").x, -1);
  EXPECT_FALSE(press(GLFW_KEY_O, true).open_case);
  model.saved = true;
  EXPECT_TRUE(click("##bones", "Open in the simulator").open_case);
  EXPECT_TRUE(press(GLFW_KEY_O, true).open_case);
}

TEST_F(SegmentPanels, AfterAFailureAnotherScanCanBeChosen) {
  model.phase = UiPhase::kFailed;
  model.loading.failure = "no";
  EXPECT_TRUE(click("##loading", "Choose another scan").choose_scan);
}

TEST_F(SegmentPanels, WorkUnderWayCanBeCancelled) {
  add_bones();
  model.job.emplace();
  model.job->what = "Growing";
  model.job->can_cancel = true;
  EXPECT_TRUE(click("##job", "Cancel").cancel_job);
}

}  // namespace
}  // namespace osteon
