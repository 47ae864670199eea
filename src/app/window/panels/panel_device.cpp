#include <algorithm>
#include <array>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

constexpr double kWarm = 0.8;  // of what the motors bear

// Share of something as a bar with its label and value over it.
void draw_share(const PanelContext& c, const char* label, double share, const std::string& value,
                ImU32 ink, const char* explanation) {
  ui::stat(label, value, explanation, ink == color::kAccent ? color::kText : ink);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float w = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({w, c.px(4)});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float part = static_cast<float>(std::clamp(share, 0.0, 1.0));
  draw->AddRectFilled(lo, {lo.x + w, lo.y + c.px(3)}, color::kField, c.px(2));
  if (part > 0)
    draw->AddRectFilled(lo, {lo.x + std::max(w * part, c.px(3)), lo.y + c.px(3)}, ink, c.px(2));
}

void draw_calibration(const PanelContext& c) {
  const DeviceHealth& health = c.model.hand.status.health;
  const bool needed = health.calibration == Calibration::kNeeded;
  const bool running = health.calibration == Calibration::kRunning;
  if (health.calibration == Calibration::kDone)
    ui::stat("Calibration", "Done", "The device knows the position of its stylus");
  if (running)
    ui::stat("Calibration", "Running", "The device is finding the position of its stylus");
  if (needed)
    ui::stat("Calibration", "! Needed",
             "The device does not know the position of its stylus; until then it gives no force",
             color::kAmber);
  if (health.advice != nullptr && *health.advice != 0) {
    ImGui::PushTextWrapPos(0);
    ui::text(color::kAmber, health.advice);
    ImGui::PopTextWrapPos();
  }
  if (!needed && !(health.calibration == Calibration::kDone)) return;
  const ImVec2 size{ImGui::GetContentRegionAvail().x, 0};
  if (needed ? ui::accent_button("Calibrate", size) : ImGui::Button("Calibrate again", size))
    c.requests.calibrate = true;
  ui::tooltip(
      "Starts the device's calibration; release the device or follow its advice until it ends");
}

void draw_dead_man(const PanelContext& c) {
  const HandModel& hand = c.model.hand;
  if (hand.has_dead_man)
    ui::stat("Dead-man", hand.dead_man_held ? "Held" : "! Released",
             "Switch or pedal that must be held down for force",
             hand.dead_man_held ? color::kText : color::kAmber);
  if (hand.status.clutched)
    ui::stat("Clutch", "Hand moves alone",
             "While the clutch is held, the device moves without the tool", color::kAccent);
}

void draw_heat(const PanelContext& c) {
  const DeviceStatus& status = c.model.hand.status;
  // What the device tells of its motors, else what the safety gate reckons from the force given.
  const bool told = status.health.motor_heat >= 0;
  const double heat = told ? status.health.motor_heat : status.safety.heat;
  const bool warm = heat >= kWarm;
  draw_share(c, "Motor heat", heat, (warm ? "! " : "") + ui::number(100 * heat, 0) + " %",
             warm ? color::kAmber : color::kAccent,
             told ? "Warmest motor, percent of its limit, measured by the device"
                  : "Estimated from the force given so far, percent of what the profile allows "
                    "continuously. Above 100 % the force limit drops.");
}

// The observer's account on a scale that shows both a light touch and a firm push.
void draw_energy(const PanelContext& c) {
  const PassivityState& p = c.model.hand.status.safety.passivity;
  constexpr double kFull_j = 0.05;
  const bool owed = p.energy_j < 0;
  draw_share(c, "Energy", std::abs(p.energy_j) / kFull_j,
             (owed ? "! " : "") + ui::number(p.energy_j * 1e3, 1) + " mJ",
             owed ? color::kAmber : color::kAccent,
             "Energy put in by the hand and not returned, millijoules. Below zero the contact "
             "would generate energy; damping then removes it.");
  ui::stat("Damping added", ui::number(p.damping_n_s_per_m, 1) + " N s/m",
           "Damping that the passivity stage added in the last tick to keep the contact stable");
  if (p.stiffness_share < 0.995)
    ui::stat("Force passed on", ui::number(100 * p.stiffness_share, 0) + " %",
             "Reduced because the contact oscillated; it rises again once nothing is touched",
             color::kAmber);
}

void draw_reports(const PanelContext& c) {
  const DeviceHealth& health = c.model.hand.status.health;
  if (health.reports_in == 0) return;
  ui::stat("Readings", std::to_string(health.reports_in),
           "Readings received since the device was opened");
  if (health.bad_reports > 0)
    ui::stat("Garbled", "! " + std::to_string(health.bad_reports),
             "Rejected readings: short, garbled or out of range. Try another cable or port.",
             color::kAmber);
}

void draw_axes(HandModel::Mapping& mapping, bool& changed) {
  const bool view = mapping.settings.axes == MappingAxes::kView;
  const float gap = ImGui::GetStyle().ItemSpacing.x / 2;
  const float w = (ImGui::GetContentRegionAvail().x - gap) / 2;
  ui::text(color::kTextQuiet, "Axes follow");
  if (ui::toggle_button("The view", view, {w, 0}) && !view) {
    mapping.settings.axes = MappingAxes::kView;
    changed = true;
  }
  ui::tooltip("Right for the hand is right on the screen in any view");
  ImGui::SameLine(0, gap);
  if (ui::toggle_button("The patient", !view, {w, 0}) && view) {
    mapping.settings.axes = MappingAxes::kPatient;
    changed = true;
  }
  ui::tooltip("The hand's directions stay those of the patient in any view");
}

void draw_clutch(HandModel::Mapping& mapping, bool& changed) {
  const int now = mapping.settings.clutch_button;
  const auto label = [](int button) {
    return button < 0 ? std::string("None") : "Button " + std::to_string(button + 1);
  };
  ui::text(color::kTextQuiet, "Clutch");
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
  if (ImGui::BeginCombo("##clutch", label(now).c_str())) {
    for (int button = -1; button < 4; ++button)
      if (ImGui::Selectable(label(button).c_str(), button == now) && button != now) {
        mapping.settings.clutch_button = button;
        changed = true;
      }
    ImGui::EndCombo();
  }
  ui::tooltip("Button of the device: while it is held, the hand moves without the tool");
}

void draw_pedal(const PanelContext& c, const char* name, const char* label, const char* wanted,
                const std::string& now) {
  const bool learning = c.model.hand.learning_pedal == name;
  ImGui::PushID(name);
  ui::stat(label, learning ? wanted : now, "Pedal or key in use; stored with the settings",
           learning ? color::kAccent : color::kText);
  const float w = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  if (ImGui::Button(learning ? "Stop" : "Set", {w, 0}))
    c.requests.learn_pedal = learning ? std::string() : std::string(name);
  ui::tooltip("Click here, then press the pedal or key to use");
  ImGui::SameLine();
  ImGui::BeginDisabled(now == "none");
  if (ImGui::Button("Remove", {w, 0})) c.requests.forget_pedal = name;
  ImGui::EndDisabled();
  ImGui::PopID();
}

void draw_mapping(const PanelContext& c) {
  HandModel::Mapping mapping = c.model.hand.mapping;
  bool changed = false;
  if (mapping.settable) {
    changed |= ui::slider("Scale", &mapping.settings.scale, kMinScale, kMaxScale, "%.2f x",
                          "At 2, one centimetre of the hand is two in the case; 0.1 to 5");
    draw_axes(mapping, changed);
    draw_clutch(mapping, changed);
    changed |= ui::slider("Own friction", &mapping.settings.friction_n, 0, kMaxFriction_n, "%.2f N",
                          "The device's own friction to compensate, newtons; 0 to 1");
    changed |= ui::slider("Own inertia", &mapping.settings.inertia_kg, 0, kMaxInertia_kg, "%.3f kg",
                          "Mass of the device's moving parts to compensate, kilograms; 0 to 0.2");
  }
  draw_pedal(c, kDeadManPedal, "Dead-man pedal", "Press it now", mapping.dead_man);
  draw_pedal(c, kClutchPedal, "Clutch pedal", "Press it now", mapping.clutch);
  draw_pedal(c, kPowerPedal, "Power pedal", "Press it now", mapping.power);
  if (changed) c.requests.mapping = mapping.settings;
}

// Two buttons beside each other; the first opens the pop-up of the mapping.
void draw_more(const PanelContext& c) {
  const float gap = ImGui::GetStyle().ItemSpacing.x / 2;
  const ImVec2 half{(ImGui::GetContentRegionAvail().x - gap) / 2, 0};
  ImGui::BeginDisabled(c.model.record.on);
  if (ImGui::Button("Mapping", half)) ImGui::OpenPopup("mapping");
  ImGui::EndDisabled();
  ui::tooltip(c.model.record.on
                  ? "Stop the recording first"
                  : "How the device moves the instrument in this case, and its pedals");
  ImGui::SameLine(0, gap);
  if (ui::toggle_button("Check-up", c.model.checkup.open, half)) c.requests.toggle_checkup = true;
  ui::tooltip("Checks this computer and the device, and says how to fix problems (F2)");
}

}  // namespace

void draw_device_section(const PanelContext& c) {
  draw_calibration(c);
  draw_dead_man(c);
  draw_heat(c);
  draw_energy(c);
  draw_reports(c);
  draw_more(c);
  const ImVec2 at{c.layout.right.x - c.px(8), ImGui::GetItemRectMin().y};
  ImGui::SetNextWindowPos(at, ImGuiCond_Appearing, {1, 0.5f});
  ImGui::SetNextWindowSize({c.px(224), 0});
  if (!ImGui::BeginPopup("mapping")) return;
  draw_mapping(c);
  ImGui::EndPopup();
}

}  // namespace osteon
