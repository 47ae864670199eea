#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

#include "segment/segment_panels.h"

namespace osteon {
namespace {

constexpr double kBrushStep = 1.25;
constexpr double kThinnestBrush_m = 0.0003, kThickestBrush_m = 0.02;

bool pressed(int key) { return ImGui::IsKeyPressed(key, false); }

void read_tool_keys(const SegmentContext& c) {
  struct ToolKey {
    int key;
    SegmentTool tool;
  };
  static constexpr std::array<ToolKey, 6> kKeys = {{{GLFW_KEY_C, SegmentTool::kCross},
                                                    {GLFW_KEY_G, SegmentTool::kGrow},
                                                    {GLFW_KEY_B, SegmentTool::kPaint},
                                                    {GLFW_KEY_X, SegmentTool::kErase},
                                                    {GLFW_KEY_S, SegmentTool::kSplit},
                                                    {GLFW_KEY_M, SegmentTool::kMerge}}};
  ToolSettings tools = c.model.tools;
  for (const ToolKey& key : kKeys)
    if (pressed(key.key)) tools.tool = key.tool;
  if (pressed(GLFW_KEY_T)) tools.preview = !tools.preview;
  double radius_m = tools.radius_m;
  if (pressed(GLFW_KEY_LEFT_BRACKET)) radius_m /= kBrushStep;
  if (pressed(GLFW_KEY_RIGHT_BRACKET)) radius_m *= kBrushStep;
  tools.radius_m = std::clamp(radius_m, kThinnestBrush_m, kThickestBrush_m);
  if (!(tools == c.model.tools)) c.requests.tools = tools;
  if (pressed(GLFW_KEY_N)) c.requests.add = true;
  if (pressed(GLFW_KEY_F)) c.requests.fit_panes = true;
}

void read_window_keys(const SegmentContext& c, bool ctrl, bool shift) {
  if (pressed(GLFW_KEY_F1)) c.requests.toggle_help = true;
  if (pressed(GLFW_KEY_F11)) c.requests.toggle_fullscreen = true;
  if (pressed(GLFW_KEY_TAB) && !ctrl) c.requests.toggle_panels = true;
  if (!ctrl) return;
  if (ImGui::IsKeyPressed(GLFW_KEY_Z, true)) (shift ? c.requests.redo : c.requests.undo) = true;
  if (ImGui::IsKeyPressed(GLFW_KEY_Y, true)) c.requests.redo = true;
  if (pressed(GLFW_KEY_S)) c.requests.save = true;
  if (pressed(GLFW_KEY_O) && c.model.saved) c.requests.open_case = true;
  if (pressed(GLFW_KEY_Q)) c.requests.quit = true;
  if (pressed(GLFW_KEY_EQUAL) || pressed(GLFW_KEY_KP_ADD)) c.requests.zoom_interface = 1.125;
  if (pressed(GLFW_KEY_MINUS) || pressed(GLFW_KEY_KP_SUBTRACT))
    c.requests.zoom_interface = 1 / 1.125;
}

}  // namespace

void read_segment_keys(const SegmentContext& c) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || c.model.asks_to_close) return;
  read_window_keys(c, io.KeyCtrl, io.KeyShift);
  if (c.model.phase == UiPhase::kReady && !io.KeyCtrl) read_tool_keys(c);
}

SegmentRequests draw_segment_ui(const SegmentModel& model, const UiFonts& fonts) {
  SegmentRequests requests;
  const SegmentLayout layout =
      make_segment_layout(model.width, model.height, model.scale, model.panels_open);
  const SegmentContext c{model, fonts, layout, requests};
  read_segment_keys(c);
  if (model.chooser) {
    draw_scan_chooser(c);
    draw_segment_notes(c);
    return requests;
  }
  if (model.phase != UiPhase::kReady) {
    draw_segment_loading(c);
    return requests;
  }
  draw_slice_panes(c);
  draw_solid_pane(c);
  if (model.panels_open) {
    draw_segment_top(c);
    draw_tool_card(c);
    draw_bone_card(c);
  }
  draw_segment_notes(c);
  if (model.help_open) draw_segment_help(c);
  if (model.asks_to_close) draw_close_question(c);
  return requests;
}

}  // namespace osteon
