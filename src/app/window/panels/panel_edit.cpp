#include <array>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

constexpr ImGuiWindowFlags kEditCard =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;

struct FallOffButton {
  FallOff fall_off;
  const char* label;
  const char* explanation;
};

constexpr std::array<FallOffButton, 4> kFallOffs = {{
    {FallOff::kSmooth, "Smooth", "Flat in the middle and at the rim: a bump without an edge"},
    {FallOff::kCone, "Cone", "Falls evenly: a point in the middle, an edge at the rim"},
    {FallOff::kDome, "Dome", "Broad, with an edge at the rim"},
    {FallOff::kSpike, "Spike", "Narrow, flat at the rim"},
}};

void draw_fall_off(const PanelContext& c) {
  const EditModel& edit = c.model.edit;
  SoftSelection wanted = edit.selection;
  double radius_mm = 1000 * wanted.radius_m;
  bool changed = ui::slider("Reach", &radius_mm, 0.5, 30, "%.1f mm",
                            "How far along the surface the bone follows your pull. The other side "
                            "of a thin part does not move");
  wanted.radius_m = radius_mm / 1000;
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
  for (const FallOffButton& button : kFallOffs) {
    if (button.fall_off != kFallOffs[0].fall_off) ImGui::SameLine(0, gap);
    if (ui::toggle_button(button.label, edit.selection.fall_off == button.fall_off, {w, 0})) {
      wanted.fall_off = button.fall_off;
      changed = true;
    }
    ui::tooltip(button.explanation);
  }
  if (changed) c.requests.edit.selection = wanted;
}

void draw_history(const PanelContext& c) {
  const EditModel& edit = c.model.edit;
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - gap) / 2;
  ImGui::BeginDisabled(edit.undo_steps == 0);
  const std::string undo = "Undo  " + std::to_string(edit.undo_steps) + "###undo";
  if (ImGui::Button(undo.c_str(), {w, 0})) c.requests.edit.undo = true;
  ImGui::EndDisabled();
  ui::tooltip(edit.forgotten_steps == 0
                  ? "Ctrl + Z"
                  : ("Ctrl + Z. The first " + std::to_string(edit.forgotten_steps) +
                     " can no longer be undone: they were not stored, to save memory")
                        .c_str());
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(edit.redo_steps == 0);
  const std::string redo = "Redo  " + std::to_string(edit.redo_steps) + "###redo";
  if (ImGui::Button(redo.c_str(), {w, 0})) c.requests.edit.redo = true;
  ImGui::EndDisabled();
  ui::tooltip("Ctrl + Shift + Z");
}

void draw_end(const PanelContext& c) {
  const EditModel& edit = c.model.edit;
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - gap) / 2;
  ImGui::BeginDisabled(!edit.changed || edit.saving);
  if (ui::accent_button(edit.saving ? "Saving ..." : "Save as a case", {w, 0}))
    c.requests.edit.save = true;
  ImGui::EndDisabled();
  ui::tooltip(
      "Writes a new case with the edited bone and opens it; it is felt as changed only then");
  ImGui::SameLine(0, gap);
  if (ImGui::Button(edit.changed ? "Discard###leave" : "Leave###leave", {w, 0}))
    c.requests.edit.leave = true;
  ui::tooltip(edit.changed ? "Restores the bone and ends editing  (E)" : "Ends editing  (E)");
}

void draw_state(const PanelContext& c) {
  const EditModel& edit = c.model.edit;
  ui::stat("Moved", ui::number(edit.displacement_mm, 2) + " mm",
           "How far the grabbed point has been dragged");
  ui::stat("Volume", ui::number(edit.volume_cm3, 3) + " cm\xc2\xb3", "Volume inside the surface");
  if (edit.sound) return;
  ImGui::PushTextWrapPos(0);
  ui::text(color::kAmber, (edit.findings + ". Undo, or drag it apart.").c_str());
  ImGui::PopTextWrapPos();
}

// The vertices that follow, larger and darker the more they do.
void draw_dots(const PanelContext& c) {
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  for (const EditDot& dot : c.model.edit.dots) {
    const ImU32 alpha = static_cast<ImU32>(70 + 185 * dot.weight) << IM_COL32_A_SHIFT;
    const ImU32 shade = (color::kAccentDim & ~IM_COL32_A_MASK) | alpha;
    draw->AddCircleFilled({dot.x, dot.y}, c.px(1.5f + 1.5f * dot.weight), shade);
  }
}

void draw_begin(const PanelContext& c) {
  if (ImGui::Button("Edit surface  (E)")) c.requests.edit.begin = true;
  ui::tooltip("Drag the surface of the chosen bone with the mouse or the device");
}

void draw_editing(const PanelContext& c) {
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted(("Editing: " + c.model.edit.bone).c_str());
  }
  ui::text(color::kTextQuiet, "Drag the bone, or hold the probe's button");
  ImGui::Dummy({c.px(280), c.px(2)});
  draw_fall_off(c);
  ImGui::Dummy({0, c.px(2)});
  draw_state(c);
  ImGui::Dummy({0, c.px(2)});
  draw_history(c);
  draw_end(c);
}

void read_edit_keys(const PanelContext& c) {
  const ImGuiIO& io = ImGui::GetIO();
  constexpr int kKeyE = 'E', kKeyZ = 'Z';  // GLFW names letters by their capitals
  if (io.WantTextInput || c.model.hand.probe_in_hand) return;
  if (!io.KeyCtrl && ImGui::IsKeyPressed(kKeyE, false))
    (c.model.edit.on ? c.requests.edit.leave : c.requests.edit.begin) = true;
  if (c.model.edit.on && io.KeyCtrl && ImGui::IsKeyPressed(kKeyZ, true))
    (io.KeyShift ? c.requests.edit.redo : c.requests.edit.undo) = true;
}

}  // namespace

void draw_edit(const PanelContext& c) {
  read_edit_keys(c);
  if (!c.model.edit.on && !c.model.edit.can_begin) return;
  if (c.model.edit.on) draw_dots(c);
  const UiRect& r = c.layout.picture;
  const float beside = c.model.panels_open ? c.layout.left.right() : r.x;
  ImGui::SetNextWindowPos({beside + c.px(12), r.y + c.px(8)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(12), c.px(8)});
  ImGui::Begin("##edit", nullptr, kEditCard);
  ImGui::PopStyleVar();
  c.model.edit.on ? draw_editing(c) : draw_begin(c);
  ImGui::End();
}

}  // namespace osteon
