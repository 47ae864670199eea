#include "ui/ui_widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace osteon::ui {
namespace {

float line_width() { return ImGui::GetContentRegionAvail().x; }

void text_right(const std::string& value, float right_edge, ImU32 color) {
  ImGui::SameLine();
  ImGui::SetCursorPosX(right_edge - ImGui::CalcTextSize(value.c_str()).x);
  text(color, value.c_str());
}

ImVec2 middle(ImVec2 a, ImVec2 b) { return {0.5f * (a.x + b.x), 0.5f * (a.y + b.y)}; }

}  // namespace

void tooltip(const char* text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 20);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void text(ImU32 color, const char* text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextUnformatted(text);
  ImGui::PopStyleColor();
}

std::string shortened(const std::string& text, float width) {
  if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
  std::string out = text;
  while (!out.empty() && ImGui::CalcTextSize((out + "...").c_str()).x > width) out.pop_back();
  return out + "...";
}

void wrapped_text(ImU32 color, const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void text_within(ImU32 color, const std::string& whole, float width) {
  const std::string shown = shortened(whole, width);
  text(color, shown.c_str());
  if (shown != whole) tooltip(whole.c_str());
}

bool section(const UiFonts& fonts, const char* title, bool open_at_first) {
  const WithFont strong(fonts.strong);
  ImGui::PushStyleColor(ImGuiCol_Header, IM_COL32(0, 0, 0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2, ImGui::GetStyle().FramePadding.y});
  const bool open = ImGui::CollapsingHeader(
      title, open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  return open;
}

void stat(const char* label, const std::string& value, const char* explanation, ImU32 color) {
  const float right = ImGui::GetCursorPosX() + line_width();
  ImGui::BeginGroup();
  text(color::kTextQuiet, label);
  text_right(value, right, color);
  ImGui::EndGroup();
  tooltip(explanation);
}

bool toggle_button(const char* label, bool active, ImVec2 size) {
  ImGui::PushStyleColor(ImGuiCol_Button, active ? color::kAccentDim : color::kField);
  ImGui::PushStyleColor(ImGuiCol_Border, active ? color::kAccent : IM_COL32(0, 0, 0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 1);
  const bool pressed = ImGui::Button(label, size);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(2);
  return pressed;
}

bool accent_button(const char* label, ImVec2 size) {
  ImGui::PushStyleColor(ImGuiCol_Button, color::kAccent);
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, IM_COL32(0x74, 0xca, 0xe4, 0xff));
  ImGui::PushStyleColor(ImGuiCol_Text, color::kGround);
  const bool pressed = ImGui::Button(label, size);
  ImGui::PopStyleColor(3);
  return pressed;
}

bool switch_row(const char* label, bool* on, const char* explanation) {
  const float h = ImGui::GetFrameHeight() * 0.7f;
  const float w = h * 1.8f;
  const float width = line_width();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton(label, {width, ImGui::GetTextLineHeight() + 4});
  if (pressed) *on = !*on;
  const bool hovered = ImGui::IsItemHovered();
  tooltip(explanation);

  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddText({at.x, at.y + 2}, hovered ? color::kText : color::kTextQuiet, label);
  const ImVec2 lo{at.x + width - w, at.y + 0.5f * (ImGui::GetTextLineHeight() + 4 - h)};
  draw->AddRectFilled(lo, {lo.x + w, lo.y + h}, *on ? color::kAccent : color::kField, h / 2);
  const float knob_x = *on ? lo.x + w - h / 2 : lo.x + h / 2;
  draw->AddCircleFilled({knob_x, lo.y + h / 2}, h / 2 - 2,
                        *on ? color::kGround : color::kTextQuiet);
  return pressed;
}

bool eye_button(const char* id, bool open, float size) {
  const bool pressed = ImGui::InvisibleButton(id, {size, size});
  const ImVec2 c = middle(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
  const ImU32 ink = ImGui::IsItemHovered() ? color::kText
                    : open                 ? color::kTextQuiet
                                           : IM_COL32(0x6a, 0x73, 0x7d, 0xff);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float a = size * 0.34f;
  draw->AddBezierQuadratic({c.x - a, c.y}, {c.x, c.y + a * 1.3f}, {c.x + a, c.y}, ink, 1.3f);
  if (open) {
    draw->AddBezierQuadratic({c.x - a, c.y}, {c.x, c.y - a * 1.3f}, {c.x + a, c.y}, ink, 1.3f);
    draw->AddCircleFilled(c, a * 0.36f, ink);
  }
  return pressed;
}

namespace {

// ImGui's slider with its frame made invisible, a thin track and a round knob drawn in its place.
bool thin_slider(const char* id, double* value, double min, double max) {
  const ImU32 none = IM_COL32(0, 0, 0, 0);
  for (const ImGuiCol c : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive,
                           ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive})
    ImGui::PushStyleColor(c, none);
  ImGui::SetNextItemWidth(line_width());
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
  const bool changed = ImGui::SliderScalar(id, ImGuiDataType_Double, value, &min, &max, "",
                                           ImGuiSliderFlags_AlwaysClamp);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(5);

  const ImVec2 lo = ImGui::GetItemRectMin();
  const ImVec2 hi = ImGui::GetItemRectMax();
  const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
  const float r = 0.38f * (hi.y - lo.y);
  const float y = 0.5f * (lo.y + hi.y);
  const float share = static_cast<float>(std::clamp((*value - min) / (max - min), 0.0, 1.0));
  const float x = lo.x + r + share * (hi.x - lo.x - 2 * r);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({lo.x, y - r / 3}, {hi.x, y + r / 3}, color::kField, r / 3);
  draw->AddRectFilled({lo.x, y - r / 3}, {x, y + r / 3}, color::kAccentDim, r / 3);
  draw->AddCircleFilled({x, y}, r, lit ? color::kText : color::kAccent);
  return changed;
}

}  // namespace

bool slider(const char* label, double* value, double min, double max, const char* format,
            const char* explanation) {
  char shown[64];
  std::snprintf(shown, sizeof shown, format, *value);
  stat(label, shown, explanation);
  const bool changed = thin_slider((std::string("##") + label).c_str(), value, min, max);
  tooltip(explanation);
  return changed;
}

bool light_pad(const char* id, float size, double* azimuth_rad, double* elevation_rad) {
  ImGui::InvisibleButton(id, {size, size});
  const ImVec2 c = middle(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
  const float r = size / 2 - 1;
  bool changed = false;
  if (ImGui::IsItemActive()) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    // The dot is the light's direction projected on the screen: x = cos(el) sin(az), y = sin(el).
    const double x = std::clamp(static_cast<double>((mouse.x - c.x) / r), -0.97, 0.97);
    const double y_max = std::sqrt(0.97 - std::min(0.96, x * x));
    const double y = std::clamp(static_cast<double>((c.y - mouse.y) / r), -y_max, y_max);
    *elevation_rad = std::asin(y);
    *azimuth_rad = std::asin(std::clamp(x / std::sqrt(1 - y * y), -1.0, 1.0));
    changed = true;
  }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddCircleFilled(c, r, color::kField, 32);
  draw->AddCircle(c, r, ImGui::IsItemHovered() ? color::kTextQuiet : color::kLine, 32, 1);
  const ImVec2 dot{c.x + r * static_cast<float>(std::cos(*elevation_rad) * std::sin(*azimuth_rad)),
                   c.y - r * static_cast<float>(std::sin(*elevation_rad))};
  draw->AddLine(c, dot, IM_COL32(0xff, 0xf0, 0xc8, 0x50), 1.5f);
  draw->AddCircleFilled(dot, size * 0.10f, IM_COL32(0xff, 0xf0, 0xc8, 0x40));
  draw->AddCircleFilled(dot, size * 0.06f, IM_COL32(0xff, 0xf0, 0xc8, 0xff));
  return changed;
}

ImU32 bone_color(std::uint32_t bone_index) {
  // Steps of the golden ratio around the colour circle spread any number of hues evenly.
  const float turns = 0.10f + 0.618034f * static_cast<float>(bone_index);
  return ImColor::HSV(turns - std::floor(turns), 0.45f, 0.86f);
}

std::string number(double value, int decimals) {
  char shown[64];
  std::snprintf(shown, sizeof shown, "%.*f", decimals, value);
  return shown;
}

std::string clock_time(double seconds, bool tenths) {
  const double whole = std::max(0.0, seconds);
  const int minutes = static_cast<int>(whole / 60);
  char shown[64];
  if (tenths)
    std::snprintf(shown, sizeof shown, "%d:%04.1f", minutes,
                  std::floor((whole - 60 * minutes) * 10) / 10);
  else
    std::snprintf(shown, sizeof shown, "%d:%02d", minutes, static_cast<int>(whole) % 60);
  return shown;
}

}  // namespace osteon::ui
