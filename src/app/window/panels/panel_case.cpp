#include <algorithm>
#include <array>
#include <string>

#include "ui/panel_ground.h"
#include "ui/ui_widgets.h"
#include "window/panels/panel_look.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

struct FeltButton {
  Felt felt;
  const char* label;
  const char* explanation;
};

constexpr std::array<FeltButton, 4> kFeltButtons = {{
    {Felt::kHull, "Hull", "One convex hull around the bone: the fastest, but it bridges hollows"},
    {Felt::kPieces, "Pieces", "Convex pieces that follow the bone within about 0.2 mm"},
    {Felt::kField, "Field", "The bone's own surface, smoothed over a quarter of a millimetre"},
    {Felt::kCovered, "Cartilage", "As field, with the cartilage of the case on the bone"},
}};

// What the probe feels of the bone. A replay and a recording belong to the case as it was opened.
void draw_felt(const PanelContext& c, std::size_t i) {
  if (i >= c.model.bone_felt.size()) return;
  ui::text(color::kTextQuiet, "Felt as");
  const bool open = i < c.model.bone_open.size() && c.model.bone_open[i];
  ImGui::BeginDisabled(c.model.replay.on || c.model.record.on || open);
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - gap) / 2;
  for (std::size_t k = 0; k < kFeltButtons.size(); ++k) {
    const FeltButton& button = kFeltButtons[k];
    if (k % 2 == 1) ImGui::SameLine(0, gap);
    const bool active = c.model.bone_felt[i] == button.felt;
    if (ui::toggle_button(button.label, active, {w, 0}) && !active)
      c.requests.felt = FeltWish{BoneId{static_cast<std::uint32_t>(i)}, button.felt};
    ui::tooltip(button.explanation);
  }
  ImGui::EndDisabled();
  ui::text(color::kTextQuiet,
           open ? "Its surface is open: its hull is felt" : "A change reopens the case");
}

void draw_appearance_popup(const PanelContext& c, std::size_t i, ViewState& view) {
  if (!ImGui::BeginPopup("appearance")) return;
  if (edit_look(c.model.bone_labels[i], view.bones[i])) c.requests.view = view;
  ImGui::Dummy({0, c.px(2)});
  draw_felt(c, i);
  ImGui::EndPopup();
}

void draw_bone_row(const PanelContext& c, std::size_t i, ViewState& view) {
  const BoneId id{static_cast<std::uint32_t>(i)};
  BoneAppearance& look = view.bones[i];
  ImGui::PushID(static_cast<int>(i));
  const float eye = c.px(18), row = ImGui::GetCursorPosY();
  draw_swatch(c, look, "appearance", "Colour, opacity and felt shape");
  draw_appearance_popup(c, i, view);
  ImGui::SameLine(0, c.px(8));
  ImGui::SetCursorPosY(row);
  const float name_w = ImGui::GetContentRegionAvail().x - eye;
  ImGui::PushStyleColor(ImGuiCol_Text, look.visible ? color::kText : color::kTextQuiet);
  const bool chosen = c.model.picked == id;
  const std::string name = ui::shortened(c.model.bone_labels[i], name_w - c.px(4));
  if (ImGui::Selectable(name.c_str(), chosen, 0, {name_w, c.px(18)})) c.requests.picked_row = id;
  ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) c.requests.hovered_row = id;
  ImGui::SameLine(0, 0);
  if (ui::eye_button("eye", look.visible, eye)) {
    look.visible = !look.visible;
    c.requests.view = view;
  }
  ui::tooltip(look.visible ? "Hide this bone" : "Show this bone");
  ImGui::PopID();
}

void draw_bones(const PanelContext& c, ViewState& view) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {c.px(8), c.px(1)});
  for (std::size_t i = 0; i < c.model.bone_labels.size() && i < view.bones.size(); ++i)
    draw_bone_row(c, i, view);
  ImGui::PopStyleVar();
}

// The card's right edge, which can be dragged.
void draw_width_handle(const PanelContext& c, float bottom) {
  const UiRect& r = c.layout.left;
  ImGui::SetNextWindowPos({r.right() - c.px(2), r.y});
  ImGui::SetNextWindowSize({c.px(6), std::max(c.px(8), bottom - r.y)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("##case_width", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("edge", {c.px(6), std::max(c.px(8), bottom - r.y)});
  if (ImGui::IsItemHovered() || ImGui::IsItemActive())
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemActive())
    c.requests.left_card = static_cast<double>((ImGui::GetIO().MousePos.x - r.x) / c.model.scale);
  ImGui::End();
}

}  // namespace

void draw_case_card(const PanelContext& c) {
  const UiRect& r = c.layout.left;
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSizeConstraints({r.w, 0}, {r.w, r.h});
  begin_panel("##case", kCardPanel);
  ViewState view = c.model.view;
  if (ui::section(c.fonts, "Bones")) draw_bones(c, view);
  draw_joint_section(c);
  draw_soft_section(c);
  draw_notes_section(c);
  if (ui::section(c.fonts, "View")) draw_view_section(c);
  draw_picture_section(c);
  const float bottom = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
  ImGui::End();
  draw_width_handle(c, bottom);
}

}  // namespace osteon
