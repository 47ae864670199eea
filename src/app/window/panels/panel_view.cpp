#include <array>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

struct PresetButton {
  const char* label;
  ViewPreset preset;
  const char* explanation;
};

// A wrist lies on its palm under the tube: the rays come from behind.
constexpr PresetButton kPa = {"PA", ViewPreset::kAp,
                              "As on a posteroanterior radiograph, without perspective (5)"};
constexpr PresetButton kAp = {"AP", ViewPreset::kAp,
                              "As on an anteroposterior radiograph, without perspective (5)"};
constexpr PresetButton kLateral = {"Lateral", ViewPreset::kLateral,
                                   "As on a lateral radiograph, without perspective (6)"};
constexpr std::array<PresetButton, 6> kWristPresets = {{
    {"Dorsal", ViewPreset::kDorsal, "From the back of the hand (1)"},
    {"Palmar", ViewPreset::kPalmar, "From the palm (2)"},
    {"Radial", ViewPreset::kRadial, "From the thumb's side (3)"},
    {"Ulnar", ViewPreset::kUlnar, "From the little finger's side (4)"},
    kPa,
    kLateral,
}};
constexpr std::array<PresetButton, 6> kKneePresets = {{
    {"Front", ViewPreset::kDorsal, "From the patella's side (1)"},
    {"Back", ViewPreset::kPalmar, "From the hollow of the knee (2)"},
    {"Lateral", ViewPreset::kRadial, "From the outer side, where the fibula is (3)"},
    {"Medial", ViewPreset::kUlnar, "From the inner side, where the other knee is (4)"},
    kAp,
    {"X-ray side", ViewPreset::kLateral, "As on a lateral radiograph, without perspective (6)"},
}};

// Seen from above, with y up: as cases stand that are no part of a body.
constexpr std::array<PresetButton, 6> kBoxPresets = {{
    {"Above", ViewPreset::kDorsal, "From above (1)"},
    {"Below", ViewPreset::kPalmar, "From below (2)"},
    {"Left", ViewPreset::kRadial, "From the left (3)"},
    {"Right", ViewPreset::kUlnar, "From the right (4)"},
    {"Plan", ViewPreset::kAp, "From above, without perspective (5)"},
    {"Side", ViewPreset::kLateral, "From the left, without perspective (6)"},
}};

void draw_presets(const PanelContext& c) {
  const float gap = c.px(4);
  const float w = (ImGui::GetContentRegionAvail().x - gap) / 2;
  const auto& presets = c.model.is_knee  ? kKneePresets
                        : c.model.is_box ? kBoxPresets
                                         : kWristPresets;
  for (std::size_t i = 0; i < presets.size(); ++i) {
    if (i % 2 == 1) ImGui::SameLine(0, gap);
    if (ImGui::Button(presets[i].label, {w, 0})) c.requests.preset = presets[i].preset;
    ui::tooltip(presets[i].explanation);
  }
  const char* const rest = c.model.is_box ? "Close up" : "Close up on the joint";
  if (ImGui::Button(c.model.picked.valid() ? "Close up on the bone" : rest,
                    {ImGui::GetContentRegionAvail().x, 0}))
    c.requests.close_up = true;
  ui::tooltip("Zooms to the chosen bone or the joint without turning (F)");
}

bool draw_light(const PanelContext& c, ViewState& view) {
  bool changed =
      ui::light_pad("light", c.px(44), &view.light_azimuth_rad, &view.light_elevation_rad);
  ui::tooltip("Direction of the main light, as seen by the viewer. Drag to move it.");
  ImGui::SameLine(0, c.px(8));
  ImGui::BeginGroup();
  ImGui::Dummy({0, c.px(4)});
  double percent = 100.0 * static_cast<double>(view.light_brightness);
  if (ui::slider("Light", &percent, 20, 200, "%.0f %%",
                 "Brightness of the main light, percent of normal; 20 to 200")) {
    view.light_brightness = static_cast<float>(percent / 100.0);
    changed = true;
  }
  ImGui::EndGroup();
  return changed;
}

bool draw_switches(ViewState& view) {
  bool changed = ui::switch_row("Contact hulls", &view.show_hulls,
                                "Shows the convex bodies that an instrument feels (H)");
  changed |= ui::switch_row(
      "Felt against seen", &view.show_felt,
      "Colours each bone by the distance of the felt surface above or below the visible one");
  changed |= ui::switch_row(
      "Temperature", &view.show_heat,
      "Colours bone that is drilled or burred by the hottest temperature that it had, and marks "
      "what died of it");
  changed |= ui::switch_row("Force arrow", &view.show_force,
                            "The force on the hand as an arrow at the probe's tip");
  changed |=
      ui::switch_row("Hand's position", &view.show_hand_ghost,
                     "Position of the hand, when bone keeps the instrument from following it");
  bool shaded = view.ambient_occlusion > 0;
  if (ui::switch_row("Soft shadows", &shaded, "Darkens the gaps between bones")) {
    view.ambient_occlusion = shaded ? 1.0f : 0.0f;
    changed = true;
  }
  return changed;
}

}  // namespace

void draw_view_section(const PanelContext& c) {
  draw_presets(c);
  ImGui::Dummy({0, c.px(2)});
  draw_observer_section(c);
  draw_sound_section(c);
  // In an exercise its card has it, where the eyes are when the picture closes in.
  if (c.model.exercise.page != ExercisePage::kRunning) draw_water_section(c);
  draw_scope_camera_section(c);
}

// Folded at first where it would push the card's end out of the window.
void draw_picture_section(const PanelContext& c) {
  constexpr float kTallWindow = 800;  // units
  if (!ui::section(c.fonts, "Light and marks", c.model.height >= c.px(kTallWindow))) return;
  ViewState view = c.model.view;
  bool changed = draw_light(c, view);
  changed |= draw_switches(view);
  if (changed) c.requests.view = view;
}

}  // namespace osteon
