#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "osteon/render/heat_colors.h"
#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

constexpr ImGuiWindowFlags kHeatLegend =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav |
    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoInputs;

ImU32 heat_ink(const std::array<float, 3>& c) {
  return ImGui::GetColorU32(ImVec4(c[0], c[1], c[2], 1));
}

float heat_place(double celsius, float width) {
  return width * static_cast<float>((celsius - kHeatStops_c.front()) /
                                    (kHeatStops_c.back() - kHeatStops_c.front()));
}

// As long as the temperatures are apart.
void draw_heat_bar(ImVec2 at, ImVec2 size) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (std::size_t k = 0; k + 1 < kHeatStops_c.size(); ++k) {
    const float from = at.x + heat_place(kHeatStops_c[k], size.x);
    const float to = at.x + heat_place(kHeatStops_c[k + 1], size.x);
    const ImU32 low = heat_ink(kHeatColors[k]), high = heat_ink(kHeatColors[k + 1]);
    draw->AddRectFilledMultiColor({from, at.y}, {to, at.y + size.y}, low, high, high, low);
  }
}

void draw_heat_ticks(const PanelContext& c, ImVec2 at, float width) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  for (const double celsius : kHeatStops_c) {
    const std::string text = std::to_string(static_cast<int>(celsius));
    const float x = at.x + heat_place(celsius, width);
    const float wide = ImGui::CalcTextSize(text.c_str()).x;
    const float left = std::clamp(x - wide / 2, at.x, at.x + width - wide);
    draw->AddLine({x, at.y}, {x, at.y + c.px(4)}, color::kTextQuiet);
    draw->AddText({left, at.y + c.px(5)}, color::kText, text.c_str());
  }
}

void draw_dead_mark(const PanelContext& c) {
  const float side = ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side}, heat_ink(kDeadColor));
  ImGui::Dummy({side, side});
  ImGui::SameLine(0, c.px(8));
  ui::text(color::kText, "dead: 47 C for 60 s, or 50 C for 30 s");
}

}  // namespace

void draw_heat_legend(const PanelContext& c) {
  if (!c.model.view.show_heat) return;
  const UiRect& r = c.layout.picture;
  // Over the other legend where there is one.
  const float beside = c.model.panels_open ? c.layout.left.right() : r.x;
  const float above = c.model.view.show_felt ? c.px(104) : c.px(12);
  ImGui::SetNextWindowPos({beside + c.px(12), r.bottom() - above}, ImGuiCond_Always, {0, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(14), c.px(10)});
  ImGui::Begin("##heat_legend", nullptr, kHeatLegend);
  ImGui::PopStyleVar();
  ui::text(color::kText, "Hottest temperature of the bone so far, C");
  const ImVec2 bar(c.px(300), c.px(10)), at = ImGui::GetCursorScreenPos();
  draw_heat_bar(at, bar);
  draw_heat_ticks(c, {at.x, at.y + bar.y}, bar.x);
  ImGui::Dummy({bar.x, bar.y + c.px(6) + ImGui::GetTextLineHeight()});
  draw_dead_mark(c);
  ImGui::End();
}

}  // namespace osteon
