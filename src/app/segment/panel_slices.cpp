#include <algorithm>
#include <cmath>
#include <string>

#include "segment/segment_panels.h"
#include "ui/ui_widgets.h"

namespace osteon {
namespace {

constexpr ImGuiWindowFlags kPane =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse |
    ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBackground;
constexpr ImU32 kCross = IM_COL32(0x4f, 0xb8, 0xd8, 0x90);
constexpr ImU32 kLetter = IM_COL32(0xe8, 0xea, 0xed, 0xff);
constexpr ImU32 kShadow = IM_COL32(0, 0, 0, 0xc0);

ImVec2 at(const UiRect& r, const PanePoint& p) {
  return {r.x + static_cast<float>(p.x), r.y + static_cast<float>(p.y)};
}

/// Legible over bright bone and dark air alike.
void outlined(ImDrawList* draw, ImVec2 where, ImU32 ink, const std::string& text) {
  for (const ImVec2& shift : {ImVec2(-1, 0), ImVec2(1, 0), ImVec2(0, -1), ImVec2(0, 1)})
    draw->AddText({where.x + shift.x, where.y + shift.y}, kShadow, text.c_str());
  draw->AddText(where, ink, text.c_str());
}

void draw_letters(const SegmentContext& c, ImDrawList* draw, const UiRect& r,
                  const SlicePlane& plane) {
  const ui::WithFont strong(c.fonts.strong);
  const float line = ImGui::GetTextLineHeight(), pad = c.px(6);
  const auto letter = [&](char sign, float x, float y) {
    const std::string text(1, sign);
    outlined(draw, {std::round(x - 0.5f * ImGui::CalcTextSize(text.c_str()).x), std::round(y)},
             kLetter, text);
  };
  const float cx = r.x + r.w / 2, cy = r.y + r.h / 2 - line / 2;
  letter(plane.left_letter, r.x + pad + line / 3, cy);
  letter(plane.right_letter, r.right() - pad - line / 3, cy);
  letter(plane.top_letter, cx, r.y + pad - c.px(2));
  letter(plane.bottom_letter, cx, r.bottom() - pad - line + c.px(2));
}

void draw_cross(ImDrawList* draw, const UiRect& r, const PanePoint& cross, float gap) {
  const ImVec2 p = at(r, cross);
  const float x = std::floor(p.x) + 0.5f, y = std::floor(p.y) + 0.5f;
  draw->AddLine({r.x, y}, {x - gap, y}, kCross);
  draw->AddLine({x + gap, y}, {r.right(), y}, kCross);
  draw->AddLine({x, r.y}, {x, y - gap}, kCross);
  draw->AddLine({x, y + gap}, {x, r.bottom()}, kCross);
}

/// A length that fits, in round millimetres.
void draw_scale_bar(const SegmentContext& c, ImDrawList* draw, const UiRect& r, double px_per_mm) {
  const double widest_px = 0.3 * static_cast<double>(r.w);
  double mm = 0;
  for (const double step : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0})
    if (step * px_per_mm <= widest_px) mm = step;
  if (mm == 0) return;
  const ui::WithFont small(c.fonts.small);
  const float length = static_cast<float>(mm * px_per_mm);
  const ImVec2 left{r.x + c.px(10), r.bottom() - c.px(10)};
  const ImVec2 right{left.x + length, left.y};
  for (const float shift : {1.0f, 0.0f}) {
    const ImU32 ink = shift > 0 ? kShadow : kLetter;
    draw->AddLine({left.x + shift, left.y + shift}, {right.x + shift, right.y + shift}, ink, 1.5f);
    for (const float x : {left.x, right.x})
      draw->AddLine({x + shift, left.y - c.px(3) + shift}, {x + shift, left.y + c.px(3) + shift},
                    ink, 1.5f);
  }
  outlined(draw, {left.x, left.y - c.px(6) - ImGui::GetTextLineHeight()}, kLetter,
           ui::number(mm, mm < 1 ? 1 : 0) + " mm");
}

bool is_brush(SegmentTool tool) {
  return tool == SegmentTool::kPaint || tool == SegmentTool::kErase;
}

void draw_brush(const SegmentContext& c, ImDrawList* draw, const SlicePane& pane) {
  if (!is_brush(c.model.tools.tool)) return;
  const float radius = static_cast<float>(1000 * c.model.tools.radius_m * pane.px_per_mm);
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool erases = c.model.tools.tool == SegmentTool::kErase || ImGui::GetIO().KeyCtrl;
  draw->AddCircle(mouse, std::max(2.0f, radius) + 1, kShadow, 48, 1);
  draw->AddCircle(mouse, std::max(2.0f, radius), erases ? color::kAmber : color::kText, 48, 1.2f);
}

void draw_split_line(const SegmentContext& c, ImDrawList* draw, const UiRect& r, std::size_t n) {
  if (!c.model.split || c.model.split->pane != n) return;
  const ImVec2 from = at(r, c.model.split->from), to = at(r, c.model.split->to);
  draw->AddLine(from, to, kShadow, 3);
  draw->AddLine(from, to, color::kAccent, 1.5f);
  for (const ImVec2& end : {from, to}) draw->AddCircleFilled(end, c.px(3), color::kAccent);
}

PaneInput read_pane(std::size_t n, const UiRect& r, bool hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool active = ImGui::IsItemActive();
  PaneInput input;
  input.pane = n;
  input.x = static_cast<double>(io.MousePos.x - r.x);
  input.y = static_cast<double>(io.MousePos.y - r.y);
  input.dx = static_cast<double>(io.MouseDelta.x);
  input.dy = static_cast<double>(io.MouseDelta.y);
  input.wheel = hovered ? static_cast<double>(io.MouseWheel) : 0;
  input.pressed = hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
  input.held = active && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  input.released = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
  input.right_held = active && ImGui::IsMouseDown(ImGuiMouseButton_Right);
  input.middle_held = active && ImGui::IsMouseDown(ImGuiMouseButton_Middle);
  input.ctrl = io.KeyCtrl;
  input.shift = io.KeyShift;
  return input;
}

void draw_caption(const SegmentContext& c, ImDrawList* draw, const UiRect& r,
                  const SlicePane& pane) {
  const ui::WithFont small(c.fonts.small);
  std::string caption = name_of(pane.plane.view);
  const bool has_room = r.w > c.px(240);  // beside the letter in the middle
  if (has_room)
    caption += "   " + std::to_string(pane.slice + 1) + " / " + std::to_string(pane.slices);
  outlined(draw, {r.x + c.px(10), r.y + c.px(7)}, kLetter, caption);
}

void draw_pane(const SegmentContext& c, std::size_t n) {
  const UiRect& r = c.layout.slices[n];
  const SlicePane& pane = c.model.panes[n];
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSize({r.w, r.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::Begin(name_of(pane.plane.view), nullptr, kPane);
  ImGui::PopStyleVar(3);
  ImGui::InvisibleButton("slice", {r.w, r.h},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const bool hovered = ImGui::IsItemHovered();
  const bool taken = hovered || ImGui::IsItemActive() || ImGui::IsItemDeactivated();
  if (taken && !c.model.asks_to_close) c.requests.pointer = read_pane(n, r, hovered);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (pane.image) draw->AddImage(pane.image, {r.x, r.y}, {r.right(), r.bottom()});
  draw_cross(draw, r, pane.cross, c.px(7));
  draw_split_line(c, draw, r, n);
  draw_letters(c, draw, r, pane.plane);
  draw_caption(c, draw, r, pane);
  draw_scale_bar(c, draw, r, pane.px_per_mm);
  if (hovered) draw_brush(c, draw, pane);
  if (hovered && !c.model.under_pointer.empty()) {
    const ui::WithFont small(c.fonts.small);
    const float width = ImGui::CalcTextSize(c.model.under_pointer.c_str()).x;
    outlined(draw, {r.right() - width - c.px(10), r.y + c.px(7)}, kLetter, c.model.under_pointer);
  }
  ImGui::End();
}

void draw_solid_caption(const SegmentContext& c, const UiRect& r) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ui::WithFont small(c.fonts.small);
  outlined(draw, {r.x + c.px(10), r.y + c.px(7)}, kLetter,
           c.model.solid_busy ? "3D   drawing ..." : "3D");
  if (!c.model.has_solid && !c.model.solid_busy) {
    const char* empty = "The bones appear here as you draw them";
    const ImVec2 size = ImGui::CalcTextSize(empty);
    draw->AddText({r.x + 0.5f * (r.w - size.x), r.y + 0.5f * (r.h - size.y)}, color::kTextQuiet,
                  empty);
  }
}

}  // namespace

void draw_slice_panes(const SegmentContext& c) {
  for (std::size_t n = 0; n < c.layout.slices.size(); ++n) draw_pane(c, n);
}

void draw_solid_pane(const SegmentContext& c) {
  const UiRect& r = c.layout.solid;
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSize({r.w, r.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::Begin("##solid", nullptr, kPane);
  ImGui::PopStyleVar(3);
  ImGui::InvisibleButton("solid", {r.w, r.h},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  const ImGuiIO& io = ImGui::GetIO();
  const bool active = ImGui::IsItemActive();
  SceneInput input;
  input.x = static_cast<double>(io.MousePos.x - r.x);
  input.y = static_cast<double>(io.MousePos.y - r.y);
  input.dx = static_cast<double>(io.MouseDelta.x);
  input.dy = static_cast<double>(io.MouseDelta.y);
  input.wheel = ImGui::IsItemHovered() ? static_cast<double>(io.MouseWheel) : 0;
  input.left = active && ImGui::IsMouseDown(ImGuiMouseButton_Left);
  input.right = active && ImGui::IsMouseDown(ImGuiMouseButton_Right);
  input.middle = active && ImGui::IsMouseDown(ImGuiMouseButton_Middle);
  input.shift = io.KeyShift;
  c.requests.solid = input;
  draw_solid_caption(c, r);
  ImGui::End();
}

}  // namespace osteon
