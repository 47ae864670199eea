#include "window/panels/panel_look.h"

#include "ui/ui_widgets.h"

namespace osteon {

void draw_swatch(const PanelContext& c, const BoneAppearance& look, const char* popup,
                 const char* explanation) {
  const float size = c.px(12), row = ImGui::GetCursorPosY();
  ImGui::SetCursorPosY(row + c.px(3));
  ImGui::PushStyleVar(ImGuiStyleVar_FrameRounding, c.px(3));
  if (ImGui::ColorButton("##swatch", ImVec4(look.color[0], look.color[1], look.color[2], 1),
                         ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                         {size, size}))
    ImGui::OpenPopup(popup);
  ImGui::PopStyleVar();
  ui::tooltip(explanation);
}

bool edit_look(const std::string& label, BoneAppearance& look) {
  ui::text(color::kTextQuiet, label.c_str());
  const bool recolored =
      ImGui::ColorPicker3("##color", look.color.data(),
                          ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoInputs |
                              ImGuiColorEditFlags_PickerHueWheel);
  double opacity = 100.0 * static_cast<double>(look.opacity);
  const bool faded = ui::slider("Opacity", &opacity, 0, 100, "%.0f %%", "Opacity, percent");
  look.opacity = static_cast<float>(opacity / 100.0);
  return recolored || faded;
}

}  // namespace osteon
