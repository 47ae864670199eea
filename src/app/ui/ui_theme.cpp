#include "ui/ui_theme.h"

namespace osteon {
namespace {

ImVec4 vec(ImU32 c) { return ImGui::ColorConvertU32ToFloat4(c); }

void apply_colors(ImGuiStyle& style) {
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = vec(color::kText);
  c[ImGuiCol_TextDisabled] = vec(color::kTextQuiet);
  c[ImGuiCol_WindowBg] = vec(color::kPanel);
  c[ImGuiCol_PopupBg] = vec(IM_COL32(0x22, 0x27, 0x2d, 0xff));
  c[ImGuiCol_ChildBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_Border] = vec(color::kLine);
  c[ImGuiCol_Separator] = vec(color::kLine);
  c[ImGuiCol_FrameBg] = c[ImGuiCol_Button] = vec(color::kField);
  c[ImGuiCol_FrameBgHovered] = c[ImGuiCol_ButtonHovered] = vec(color::kFieldHover);
  c[ImGuiCol_FrameBgActive] = c[ImGuiCol_ButtonActive] = vec(color::kAccentDim);
  c[ImGuiCol_Header] = vec(color::kAccentDim);
  c[ImGuiCol_HeaderHovered] = vec(color::kFieldHover);
  c[ImGuiCol_HeaderActive] = vec(color::kAccentDim);
  c[ImGuiCol_SliderGrab] = c[ImGuiCol_CheckMark] = c[ImGuiCol_PlotHistogram] = vec(color::kAccent);
  c[ImGuiCol_SliderGrabActive] = vec(color::kText);
  c[ImGuiCol_NavHighlight] = vec(color::kAccent);
  c[ImGuiCol_ScrollbarBg] = ImVec4(0, 0, 0, 0);
  c[ImGuiCol_ScrollbarGrab] = vec(color::kField);
  c[ImGuiCol_ScrollbarGrabHovered] = vec(color::kFieldHover);
  c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.5f);
}

}  // namespace

void apply_theme(float scale) {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  apply_colors(style);
  style.WindowPadding = {8, 8};
  style.FramePadding = {8, 3};
  style.ItemSpacing = {8, 4};
  style.ItemInnerSpacing = {6, 4};
  style.WindowRounding = 6;
  style.PopupRounding = style.FrameRounding = style.GrabRounding = 4;
  style.WindowBorderSize = style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.ScrollbarSize = 8;
  style.GrabMinSize = 8;
  style.WindowMinSize = {16, 16};
  style.AntiAliasedLinesUseTex = false;  // they would need mixed texels
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace osteon
