#include <algorithm>

#include "ui/ui_widgets.h"
#include "window/panels/panel_look.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

void draw_soft_appearance(const PanelContext& c, std::size_t i, ViewState& view) {
  if (!ImGui::BeginPopup("soft_appearance")) return;
  if (edit_look(c.model.soft_labels[i], view.softs[i])) c.requests.view = view;
  ImGui::EndPopup();
}

void draw_soft_row(const PanelContext& c, std::size_t i, ViewState& view) {
  BoneAppearance& look = view.softs[i];
  ImGui::PushID(static_cast<int>(i));
  const float eye = c.px(18), row = ImGui::GetCursorPosY();
  draw_swatch(c, look, "soft_appearance", "Colour and opacity");
  draw_soft_appearance(c, i, view);
  ImGui::SameLine(0, c.px(8));
  ImGui::SetCursorPosY(row);
  const float left = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - eye;
  ui::text_within(look.visible ? color::kText : color::kTextQuiet, c.model.soft_labels[i],
                  left - c.px(6) - ImGui::GetCursorPosX());
  ImGui::SameLine();
  ImGui::SetCursorPos({left, row});
  if (ui::eye_button("eye", look.visible, eye)) {
    look.visible = !look.visible;
    c.requests.view = view;
  }
  ui::tooltip(look.visible ? "Hide it" : "Show it");
  ImGui::PopID();
}

/// Shows or hides all at once; the skin, which covers the rest, only has its own eye.
void draw_all(const PanelContext& c, ViewState& view) {
  const auto inner = [](const BoneAppearance& look) { return look.opacity > 0.5f; };
  const bool any = std::any_of(view.softs.begin(), view.softs.end(),
                               [&](const auto& look) { return inner(look) && look.visible; });
  if (!ui::toggle_button(any ? "Hide all###all" : "Show all but the skin###all", any,
                         {ImGui::GetContentRegionAvail().x, 0}))
    return;
  for (BoneAppearance& look : view.softs)
    if (any || inner(look)) look.visible = !any;
  c.requests.view = view;
}

}  // namespace

void draw_soft_section(const PanelContext& c) {
  if (c.model.soft_labels.empty() || !ui::section(c.fonts, "Soft parts", false)) return;
  ViewState view = c.model.view;
  ImGui::PushTextWrapPos(0);
  ui::text(color::kTextQuiet, "Felt only if an exercise or --soft says so");
  ImGui::PopTextWrapPos();
  ImGui::PushID("soft");  // the bones' rows have numbers too
  draw_all(c, view);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {c.px(8), c.px(1)});
  for (std::size_t i = 0; i < c.model.soft_labels.size() && i < view.softs.size(); ++i)
    draw_soft_row(c, i, view);
  ImGui::PopStyleVar();
  ImGui::PopID();
}

}  // namespace osteon
