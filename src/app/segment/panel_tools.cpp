#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "segment/segment_panels.h"
#include "ui/panel_ground.h"
#include "ui/ui_widgets.h"

namespace osteon {
namespace {

struct ToolButton {
  SegmentTool tool;
  const char* label;
  const char* explanation;
  const char* hint;
};

constexpr std::array<ToolButton, 6> kTools = {{
    {SegmentTool::kCross, "Look", "Moves the cross-hair and chooses bones (C)",
     "Click or drag: the other views follow."},
    {SegmentTool::kGrow, "Grow", "Selects all bone connected to the click (G)",
     "Click on bone. Connected tinted voxels become one bone."},
    {SegmentTool::kPaint, "Paint", "Adds voxels to the chosen bone (B)",
     "Drag to add to the chosen bone; with Ctrl to erase."},
    {SegmentTool::kErase, "Erase", "Removes voxels from the chosen bone (X)",
     "Drag to remove voxels from the chosen bone."},
    {SegmentTool::kSplit, "Split", "Splits bones that are joined (S)",
     "Drag from one bone to the other, or click to split at the neck."},
    {SegmentTool::kMerge, "Merge", "Joins pieces of one bone (M)",
     "Choose a bone in the list, then click on the pieces that belong to it."},
}};

const ToolButton& button_of(SegmentTool tool) {
  return *std::find_if(kTools.begin(), kTools.end(),
                       [tool](const ToolButton& b) { return b.tool == tool; });
}

void draw_tool_buttons(const SegmentContext& c, ToolSettings& tools) {
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  for (std::size_t i = 0; i < kTools.size(); ++i) {
    if (i % 3 != 0) ImGui::SameLine(0, gap);
    if (ui::toggle_button(kTools[i].label, tools.tool == kTools[i].tool, {w, 0}))
      tools.tool = kTools[i].tool;
    ui::tooltip(kTools[i].explanation);
  }
  ImGui::PushTextWrapPos(0);
  ui::text(color::kTextQuiet, button_of(tools.tool).hint);
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, c.px(2)});
}

void draw_brush_options(ToolSettings& tools) {
  double radius_mm = 1000 * tools.radius_m;
  if (ui::slider("Brush", &radius_mm, 0.3, 20, "%.1f mm", "Radius of the brush; [ and ] change it"))
    tools.radius_m = radius_mm / 1000;
  ui::switch_row("Ball", &tools.ball, "The brush reaches into neighbouring slices too");
  ui::switch_row("Within threshold", &tools.within,
                 "The brush touches only voxels within the threshold below");
  ui::switch_row("Over other bones", &tools.over_others,
                 "The brush may take voxels that belong to another bone");
}

void draw_grow_options(ToolSettings& tools) {
  ui::switch_row("New bone each click", &tools.fresh,
                 "Off: a click adds to the chosen bone. Shift + click does the opposite");
  ui::switch_row("With marrow", &tools.fill, "Includes what the bone encloses");
  double reach_mm = 1000 * tools.reach_m;
  const char* format = reach_mm > 0 ? "%.0f mm" : "no limit";
  if (ui::slider("Reach", &reach_mm, 0, 60, format,
                 "Greatest distance from the click, for bone that leaks into other structures; 0: "
                 "no limit"))
    tools.reach_m = std::round(reach_mm) / 1000;
}

void draw_tool_options(const SegmentContext& c, ToolSettings& tools) {
  const float width = ImGui::GetContentRegionAvail().x;
  switch (tools.tool) {
    case SegmentTool::kPaint:
    case SegmentTool::kErase:
      return draw_brush_options(tools);
    case SegmentTool::kGrow:
      return draw_grow_options(tools);
    case SegmentTool::kSplit:
      ImGui::BeginDisabled(c.model.chosen == 0);
      if (ImGui::Button("Split the chosen bone", {width, 0})) c.requests.split_chosen = true;
      ImGui::EndDisabled();
      ui::tooltip("Splits it at its necks, the narrowest first");
      return;
    case SegmentTool::kCross:
    case SegmentTool::kMerge:
      return;
  }
}

void draw_threshold(const SegmentContext& c, ToolSettings& tools) {
  const HuRange ends = c.model.values;
  double lo = tools.range.lo, hi = std::min(tools.range.hi, ends.hi);
  const bool from = ui::slider("From", &lo, ends.lo, ends.hi, "%.0f HU",
                               "Darker voxels do not count as bone. The suggested value is "
                               "half-way between the scan's soft tissue and bone");
  const bool to = ui::slider("To", &hi, ends.lo, ends.hi, "%.0f HU",
                             "Brighter voxels do not count: they are metal");
  if (from) tools.range.lo = static_cast<int>(std::lround(lo));
  if (from) tools.range.hi = std::max(tools.range.hi, tools.range.lo);
  if (to) tools.range.hi = static_cast<int>(std::lround(hi));
  // At its end the slider means: however bright.
  if (to && tools.range.hi >= ends.hi) tools.range.hi = 32767;
  if (to) tools.range.lo = std::min(tools.range.lo, tools.range.hi);
  ui::switch_row("Show in the slices", &tools.preview,
                 "Tints what is within the threshold and belongs to no bone yet (T)");
  if (ImGui::Button("Make a bone of each part", {ImGui::GetContentRegionAvail().x, 0}))
    c.requests.find_bodies = true;
  ui::tooltip(
      "Every connected tinted part becomes a bone, but no specks and nothing outside the body, "
      "such as a head rest");
}

void draw_grey(const SegmentContext& c) {
  GreyWindow grey = c.model.grey;
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - gap) / 2;
  if (ui::toggle_button("Bone", grey == kBoneWindow, {w, 0})) grey = kBoneWindow;
  ImGui::SameLine(0, gap);
  if (ui::toggle_button("Soft tissue", grey == kSoftWindow, {w, 0})) grey = kSoftWindow;
  ui::slider("Level", &grey.level_hu, -1024, 3071, "%.0f HU",
             "Shown as middle grey. Right drag on a slice, up and down, changes it too");
  ui::slider("Width", &grey.width_hu, 20, 6000, "%.0f HU",
             "From black to white. Right drag on a slice, left and right, changes it too");
  if (!(grey == c.model.grey)) c.requests.grey = grey;
}

}  // namespace

void draw_tool_card(const SegmentContext& c) {
  const UiRect& r = c.layout.tools;
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSize({r.w, r.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(12), c.px(8)});
  begin_panel("##tools", kSideCard);
  ImGui::PopStyleVar(3);
  ToolSettings tools = c.model.tools;
  if (ui::section(c.fonts, "Tool")) {
    draw_tool_buttons(c, tools);
    draw_tool_options(c, tools);
    ImGui::Dummy({0, c.px(4)});
  }
  if (ui::section(c.fonts, "Threshold")) {
    draw_threshold(c, tools);
    ImGui::Dummy({0, c.px(4)});
  }
  if (ui::section(c.fonts, "Brightness")) draw_grey(c);
  ImGui::End();
  if (!(tools == c.model.tools)) c.requests.tools = tools;
}

}  // namespace osteon
