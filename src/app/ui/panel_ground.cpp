#include "ui/panel_ground.h"

#include <epoxy/gl.h>

#include <cmath>

#include "ui/ui_theme.h"

namespace osteon {
namespace {

/// Clears the clip rectangle of the command that calls it.
void clear_ground(const ImDrawList*, const ImDrawCmd* command) {
  const ImDrawData& data = *ImGui::GetDrawData();
  const ImVec2 scale = data.FramebufferScale;
  const ImVec4& clip = command->ClipRect;
  const auto px = [](float v) { return static_cast<GLint>(v); };
  const float left = (clip.x - data.DisplayPos.x) * scale.x;
  const float bottom = (data.DisplaySize.y - (clip.w - data.DisplayPos.y)) * scale.y;
  const ImVec4 color = ImGui::ColorConvertU32ToFloat4(color::kPanel);
  glScissor(px(left), px(bottom), px((clip.z - clip.x) * scale.x), px((clip.w - clip.y) * scale.y));
  glClearColor(color.x, color.y, color.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

/// The strips with the rounded corners are filled, what lies between them is cleared.
void draw_ground(ImVec2 lo, ImVec2 hi, float rounding) {
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const ImVec2 middle_lo(lo.x, lo.y + rounding), middle_hi(hi.x, hi.y - rounding);
  if (middle_hi.y <= middle_lo.y) return draw->AddRectFilled(lo, hi, color::kPanel, rounding);
  draw->PushClipRect(middle_lo, middle_hi);
  draw->AddCallback(clear_ground, nullptr);
  draw->PopClipRect();
  if (rounding <= 0) return;
  draw->AddRectFilled(lo, {hi.x, middle_lo.y}, color::kPanel, rounding,
                      ImDrawFlags_RoundCornersTop);
  draw->AddRectFilled({lo.x, middle_hi.y}, hi, color::kPanel, rounding,
                      ImDrawFlags_RoundCornersBottom);
}

}  // namespace

void begin_panel(const char* name, ImGuiWindowFlags flags) {
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32_BLACK_TRANS);
  ImGui::Begin(name, nullptr, flags);
  ImGui::PopStyleColor();
  const ImVec2 lo = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  draw_ground(lo, {lo.x + size.x, lo.y + size.y}, std::ceil(ImGui::GetStyle().WindowRounding));
}

}  // namespace osteon
