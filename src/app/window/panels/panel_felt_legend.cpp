#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "osteon/render/felt_colors.h"
#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

constexpr ImGuiWindowFlags kLegend =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoInputs;

ImU32 color_at(double height_m) {
  const std::array<float, 3> c = felt_color(height_m);
  return ImGui::GetColorU32(ImVec4(c[0], c[1], c[2], 1));
}

// Two halves, each an even run of colour.
void draw_bar(ImVec2 at, ImVec2 size) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float middle = at.x + size.x / 2;
  const ImU32 low = color_at(-kFeltRange_m), none = color_at(0), high = color_at(kFeltRange_m);
  draw->AddRectFilledMultiColor(at, {middle, at.y + size.y}, low, none, none, low);
  draw->AddRectFilledMultiColor({middle, at.y}, {at.x + size.x, at.y + size.y}, none, high, high,
                                none);
}

void draw_ticks(const PanelContext& c, ImVec2 at, float width) {
  constexpr int kTicks = 5;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (int i = 0; i < kTicks; ++i) {
    const double mm = 1000 * kFeltRange_m * (2.0 * i / (kTicks - 1) - 1);
    char text[16];
    std::snprintf(text, sizeof text, i == kTicks / 2 ? "0" : "%+.2f", mm);
    const float x = at.x + width * static_cast<float>(i) / (kTicks - 1);
    const float wide = ImGui::CalcTextSize(text).x;
    const float left = std::clamp(x - wide / 2, at.x, at.x + width - wide);
    draw->AddLine({x, at.y}, {x, at.y + c.px(4)}, color::kTextQuiet);
    draw->AddText({left, at.y + c.px(5)}, color::kText, text);
  }
}

void draw_scale(const PanelContext& c) {
  const ImVec2 bar(c.px(300), c.px(10));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_bar(at, bar);
  draw_ticks(c, {at.x, at.y + bar.y}, bar.x);
  ImGui::Dummy({bar.x, bar.y + c.px(6) + ImGui::GetTextLineHeight()});
  const float right = ImGui::CalcTextSize("over it").x;
  ui::text(color::kTextQuiet, "under it");
  ImGui::SameLine(c.px(14) + bar.x - right);
  ui::text(color::kTextQuiet, "over it");
}

}  // namespace

void draw_felt_legend(const PanelContext& c) {
  if (!c.model.view.show_felt) return;
  const UiRect& r = c.layout.picture;
  // Beside the left card, so that the middle of the picture stays free.
  const float beside = c.model.panels_open ? c.layout.left.right() : r.x;
  ImGui::SetNextWindowPos({beside + c.px(12), r.bottom() - c.px(12)}, ImGuiCond_Always, {0, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(14), c.px(10)});
  ImGui::Begin("##felt_legend", nullptr, kLegend);
  ImGui::PopStyleVar();
  ui::text(color::kText, "Felt surface relative to the visible one, mm");
  if (c.model.felt_measured < 1)
    ImGui::ProgressBar(static_cast<float>(c.model.felt_measured), {c.px(300), 0}, "Measuring");
  else
    draw_scale(c);
  ImGui::End();
}

}  // namespace osteon
