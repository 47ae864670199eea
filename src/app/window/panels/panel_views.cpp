#include <array>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

constexpr std::array<PictureLayout, kPictureLayouts> kLayouts = {
    PictureLayout::kOutside, PictureLayout::kScope, PictureLayout::kPanorama, PictureLayout::kAll,
    PictureLayout::kFluoro};
constexpr std::array<const char*, kPictureLayouts> kWhat = {
    "Bones and instruments from outside (F5). V goes to the next view.",
    "The picture of the arthroscope, held or resting (F6)",
    "Transparent bones, with a yellow cone where the scope looks (F7)",
    "The scope large; panorama and outside beside it (F8)",
    "The last X-ray picture (F9); B takes one of the current scene"};

void draw_message(const PanelContext& c, const PaneModel& shown, int index) {
  const bool xray = shown.pane.kind == PaneKind::kFluoro && shown.pane.large;
  const UiRect r = xray ? xray_places(shown.pane.area, c.model.scale).picture : shown.pane.area;
  const std::string name = "##pane" + std::to_string(index);
  ImGui::SetNextWindowPos({r.x + r.w / 2, r.y + r.h / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(c.px(320), r.w - c.px(16)), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  // Behind it may be anything, from black to a bright surface.
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(0x10, 0x12, 0x15, 0xd8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(12), c.px(8)});
  ImGui::Begin(name.c_str(), nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PushStyleColor(ImGuiCol_Text, color::kText);
  ImGui::TextWrapped("%s", shown.message.c_str());
  ImGui::PopStyleColor();
  if (shown.offers_scope) {
    ImGui::Dummy({0, c.px(4)});
    if (ui::accent_button("Take a scope")) c.requests.views.take_scope = true;
    ui::tooltip("The active hand takes a 30-degree arthroscope");
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

void draw_frame(const PanelContext& c, const Pane& pane) {
  ImDrawList* draw = ImGui::GetBackgroundDrawList();
  const UiRect& r = pane.area;
  if (!pane.large)
    draw->AddRect({r.x, r.y}, {r.right(), r.bottom()}, color::kLine, c.px(2), 0, c.px(1));
  const ui::WithFont small(c.fonts.small);
  const ImVec2 at{r.x + c.px(8), r.y + c.px(6)};
  draw->AddText({at.x + 1, at.y + 1}, IM_COL32(0, 0, 0, 0xc0), title_of(pane.kind));
  draw->AddText(at, color::kTextQuiet, title_of(pane.kind));
}

}  // namespace

void draw_panes(const PanelContext& c) {
  if (c.model.views.layout == PictureLayout::kOutside) return;
  int index = 0;
  for (const PaneModel& shown : c.model.views.panes) {
    draw_frame(c, shown.pane);
    if (shown.pane.kind == PaneKind::kFluoro && shown.pane.large)
      draw_xray_desk(c, shown.pane.area);
    if (!shown.message.empty()) draw_message(c, shown, index);
    ++index;
  }
}

float layout_chooser_width(const PanelContext& c, bool wide) {
  const ImGuiStyle& style = ImGui::GetStyle();
  if (!wide) return c.px(112);
  float width = 0;
  for (const PictureLayout layout : kLayouts)
    width += ImGui::CalcTextSize(title_of(layout)).x + 2 * style.FramePadding.x + c.px(2);
  return width;
}

void draw_layout_chooser(const PanelContext& c, bool wide) {
  const PictureLayout now = c.model.views.layout;
  if (wide) {
    for (std::size_t k = 0; k < kLayouts.size(); ++k) {
      if (k > 0) ImGui::SameLine(0, c.px(2));
      if (ui::toggle_button(title_of(kLayouts[k]), now == kLayouts[k]))
        c.requests.views.layout = kLayouts[k];
      ui::tooltip(kWhat[k]);
    }
    return;
  }
  ImGui::SetNextItemWidth(layout_chooser_width(c, false));
  if (!ImGui::BeginCombo("##layout", title_of(now))) {
    ui::tooltip("What the picture shows (V: the next; F5 to F9)");
    return;
  }
  for (std::size_t k = 0; k < kLayouts.size(); ++k) {
    if (ImGui::Selectable(title_of(kLayouts[k]), now == kLayouts[k]))
      c.requests.views.layout = kLayouts[k];
    ui::tooltip(kWhat[k]);
  }
  ImGui::EndCombo();
}

void draw_observer_section(const PanelContext& c) {
  const ObserverModel& observer = c.model.views.observer;
  bool open = observer.open;
  if (ui::switch_row(
          "Second window", &open,
          "A window without controls for observers, on the second screen if there is one (F3)"))
    c.requests.views.toggle_observer = true;
  if (!observer.open) return;
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  const bool chooses = ImGui::BeginCombo("##observer", title_of(observer.layout));
  ui::tooltip("What the second window shows");
  if (!chooses) return;
  for (const PictureLayout layout : kLayouts)
    if (ImGui::Selectable(title_of(layout), layout == observer.layout))
      c.requests.views.observer_layout = layout;
  ImGui::EndCombo();
}

void draw_water_section(const PanelContext& c) {
  if (!c.model.views.water) return;
  const WaterModel& water = *c.model.views.water;
  ImGui::Dummy({0, c.px(2)});
  WaterSettings settings = water.settings;
  double pump_mmhg = settings.pump_pa / kPa_per_mmHg, outlet_percent = 100 * settings.outlet_open;
  ImGui::BeginDisabled(!water.can_set);
  bool changed = ui::slider("Pump", &pump_mmhg, 0, 150, "%.0f mmHg",
                            "Pressure of the pump that fills the joint. More of it stops bleeding");
  changed |= ui::slider("Outlet", &outlet_percent, 0, 100, "%.0f %%",
                        "How far the outlet is open. More flow clears the water, but the pressure "
                        "in the joint falls");
  ImGui::EndDisabled();
  const std::string joint = ui::number(water.pressure_pa / kPa_per_mmHg, 0) + " mmHg";
  const std::string lost = ui::number(100 * water.turbidity, 0) + " %";
  if (water.collapsed)
    ui::wrapped_text(color::kAmber, "In the joint " + joint +
                                        ": too little to hold it open, nothing is seen. Raise the "
                                        "pump, close the outlet, or suck less.");
  else
    ui::text(color::kTextQuiet, ("In the joint " + joint).c_str());
  ui::text(color::kTextQuiet, ("Light lost " + lost).c_str());
  if (changed) c.requests.views.water = {kPa_per_mmHg * pump_mmhg, 0.01 * outlet_percent};
}

void draw_scope_camera_section(const PanelContext& c) {
  if (!c.model.views.scope_camera) return;
  constexpr double kHalogen_k = 2800, kCold_k = 8000;
  const ScopeCameraModel& camera = *c.model.views.scope_camera;
  WhiteBalance white = camera.white;
  if (ui::slider("Light source", &white.light_k, kHalogen_k, kCold_k, "%.0f K",
                 "Colour temperature of the scope's light: halogen has 3200 K, xenon 6000 K. "
                 "Balance the camera to it"))
    c.requests.views.white_balance = white;
  const float gap = c.px(4);
  const float w = ImGui::GetContentRegionAvail().x;
  const float still_w = ImGui::CalcTextSize("Still").x + 2 * ImGui::GetStyle().FramePadding.x;
  const bool balanced = white.balance_k == white.light_k;
  ImGui::BeginDisabled(balanced);
  if (ImGui::Button("White balance", {w - gap - still_w, 0}))
    c.requests.views.white_balance = WhiteBalance{white.light_k, white.light_k};
  ImGui::EndDisabled();
  ui::tooltip("Balances the camera as with a white swab before the lens");
  ImGui::SameLine(0, gap);
  ImGui::BeginDisabled(!camera.looks);
  if (ImGui::Button("Still", {still_w, 0})) c.requests.views.keep_still = true;
  ImGui::EndDisabled();
  ui::tooltip("Saves the scope's picture as PNG (C)");
}

void draw_sound_section(const PanelContext& c) {
  const SoundModel& sound = c.model.views.sound;
  if (!sound.problem.empty() && sound.volume > 0) {
    ui::text(color::kTextQuiet, "No sound");
    ui::tooltip(sound.problem.c_str());
    return;
  }
  double percent = 100 * sound.volume;
  if (ui::slider("Sound", &percent, 0, 100, "%.0f %%",
                 "Volume of motors, suction, knocks and alarms; 0 is silent"))
    c.requests.views.sound_volume = percent / 100;
}

std::string film_label(const ScreenFilmModel& film) {
  if (!film.on) return "Film";
  const std::string size = ui::number(film.megabytes, 1) + " MB";
  return (film.ending ? "Ending, " : "Stop  " + ui::clock_time(film.seconds, false) + "  ") + size;
}

void draw_film_button(const PanelContext& c) {
  const ScreenFilmModel& film = c.model.views.film;
  ImGui::BeginDisabled(film.ending);
  if (ui::toggle_button((film_label(film) + "###film").c_str(), film.on))
    c.requests.views.toggle_film = true;
  ImGui::EndDisabled();
  ui::tooltip(film.on ? ("Ends the film: " + film.file + " (F4)").c_str()
                      : "A film of this window, with its sound, that browsers play (F4)");
}

void read_layout_keys(const PanelContext& c) {
  constexpr int kF5 = 294;  // GLFW's number
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
  for (std::size_t k = 0; k < kLayouts.size(); ++k)
    if (pressed(kF5 + static_cast<int>(k))) c.requests.views.layout = kLayouts[k];
  // V runs the motor of an instrument in hand.
  if (pressed('V') && !c.model.hand.probe_in_hand)
    c.requests.views.layout = next_layout(c.model.views.layout);
  if (pressed(kF5 - 2)) c.requests.views.toggle_observer = true;
  if (pressed(kF5 - 1)) c.requests.views.toggle_film = true;
  if (pressed('C') && c.model.views.scope_camera) c.requests.views.keep_still = true;
  if (pressed('B') && c.model.views.can_shoot) c.requests.views.shoot = true;
}

}  // namespace osteon
