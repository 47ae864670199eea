#include <string>

#include "ui/panel_ground.h"
#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

bool has_motors(const HandModel& hand) { return hand.info.peak_force_n > 0; }

bool is_slow(const HandModel& hand) { return hand.haptic.rate_hz > 0 && hand.haptic.rate_hz < 950; }

void draw_device_menu(const PanelContext& c) {
  const HandModel& hand = c.model.hand;
  const bool known = hand.device >= 0 && hand.device < static_cast<int>(hand.devices.size());
  std::string name = known ? hand.devices[static_cast<std::size_t>(hand.device)] : "None";
  if (c.model.replay.on) name = "The recorded hand";
  const float w = ImGui::GetContentRegionAvail().x;
  const float arrow = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().FramePadding.x;
  const std::string shown = ui::shortened(name, w - arrow);
  ImGui::SetNextItemWidth(w);
  ImGui::BeginDisabled(c.model.record.on || c.model.replay.on);
  if (ImGui::BeginCombo("##device", shown.c_str(), ImGuiComboFlags_HeightLarge)) {
    for (int i = 0; i < static_cast<int>(hand.devices.size()); ++i) {
      ImGui::PushID(i);
      if (ImGui::Selectable(hand.devices[static_cast<std::size_t>(i)].c_str(), i == hand.device))
        c.requests.device = i;
      ImGui::PopID();
    }
    ImGui::Separator();
    if (ImGui::Selectable("Not here? Check-up (F2)")) c.requests.toggle_checkup = true;
    ImGui::EndCombo();
  }
  ImGui::EndDisabled();
  const std::string chosen = name + ": the device in your hand. A new choice restarts the run.";
  ui::tooltip(c.model.record.on   ? "Stop the recording before choosing another device"
              : c.model.replay.on ? "Leave the replay to use an instrument yourself"
                                  : chosen.c_str());
}

void draw_force_off(const PanelContext& c) {
  ImGui::PushTextWrapPos(0);
  const std::string why = std::string(describe(c.model.hand.status.cause)) + ".";
  ui::text(color::kRed, why.c_str());
  if (c.model.hand.status.cause == ForceOff::kWatchdog)
    ui::text(color::kTextQuiet, "This computer was too busy. Close other programs, then resume.");
  ImGui::PopTextWrapPos();
  if (ui::accent_button("Resume", {ImGui::GetContentRegionAvail().x, 0}))
    c.requests.force_on = true;
  ui::tooltip("Switches the force on again; it rises over half a second (Enter)");
}

void draw_force_state(const PanelContext& c) {
  const HandModel& hand = c.model.hand;
  if (hand.probe_by_mouse && !c.model.replay.on) {
    if (ui::toggle_button(
            hand.probe_in_hand ? "Release the instrument  (M)" : "Take the instrument  (M)",
            hand.probe_in_hand, {ImGui::GetContentRegionAvail().x, 0}))
      c.requests.toggle_probe = true;
    ui::tooltip(
        "The mouse then moves the instrument instead of the view. Hold Space to take it while the "
        "key "
        "is down.");
  }
  if (c.model.replay.on) return;
  // What has no motors goes on by itself; only a device that is gone must be told.
  const bool gone = hand.status.cause == ForceOff::kDisconnect;
  if (hand.status.cause != ForceOff::kNone && (has_motors(hand) || gone)) return draw_force_off(c);
  if (!has_motors(hand)) {
    ui::text(color::kTextQuiet, "Force is shown, not felt");
    ui::tooltip(
        "This device has no motors. The instrument still stays outside bone, but your hand may go "
        "on "
        "into it.");
    return;
  }
  if (ImGui::Button("Force off  (Esc)", {ImGui::GetContentRegionAvail().x, 0}))
    c.requests.force_off = true;
  ui::tooltip("Switches the motors off at once");
}

// Of a ligament its tension as well, and what is left of one that was cut.
void draw_soft_rows(const PanelContext& c) {
  for (const SoftRow& row : c.model.soft_rows) {
    if (row.soft >= c.model.soft_labels.size()) continue;
    ui::stat(c.model.soft_labels[row.soft].c_str(), ui::number(row.force_n, 2) + " N",
             "Force of the instrument on this soft part, newtons");
    if (row.tension_n >= 0)
      ui::stat("  tension", ui::number(row.tension_n, 1) + " N",
               "With this force the whole ligament is stretched, by bones and hands, newtons");
    if (row.left < 1)
      ui::stat("  left", ui::number(100 * row.left, 0) + " %",
               "Share of the ligament's strands that is neither cut nor torn. It tears at this "
               "share of its failure load");
  }
}

void draw_contacts(const PanelContext& c) {
  draw_soft_rows(c);
  if (c.model.contacts.empty()) {
    if (!c.model.soft_rows.empty()) return;
    ui::text(color::kTextQuiet, "Nothing touched");
    return;
  }
  // An instrument that is taken in bone has no force until it has been free once.
  bool felt = false;
  for (const ContactRow& row : c.model.contacts) {
    felt = felt || row.force_n > 0;
    const bool known = row.bone.index < c.model.bone_labels.size();
    const std::string label = known ? c.model.bone_labels[row.bone.index] : "Bone";
    ui::stat(label.c_str(), ui::number(row.force_n, 2) + " N",
             row.sticking
                 ? "Force between instrument and this bone, newtons; static friction holds it"
                 : "Force between instrument and this bone, newtons; it slides");
  }
  if (!felt) ui::text(color::kAmber, "Not felt: draw it clear first");
}

void draw_feel(const PanelContext& c) {
  const HandModel& hand = c.model.hand;
  ImGui::BeginDisabled(c.model.replay.on);
  double stiffness = hand.stiffness_n_per_m;
  if (ui::slider("Stiffness", &stiffness, 200, hand.stiffness_max_n_per_m, "%.0f N/m",
                 "Stiffness of the virtual coupling, newtons per metre. Each bone's material and "
                 "the device's profile limit it."))
    c.requests.commands.push_back({CommandKind::kSetStiffness, stiffness});
  double friction = hand.friction_scale;
  if (ui::slider("Friction", &friction, 0, 2, "%.2f x",
                 "Factor on every bone's friction; 0 is frictionless, 1 is the case's own"))
    c.requests.commands.push_back({CommandKind::kSetFrictionScale, friction});
  bool held = hand.bones_held;
  if (ui::switch_row(
          "Bones held still", &held,
          "On: bones do not move. Off: springs hold them, and a push moves them a little"))
    c.requests.commands.push_back({CommandKind::kHoldBones, held ? 1.0 : 0.0});
  ImGui::EndDisabled();
}

void draw_rates(const PanelContext& c) {
  const HandModel& hand = c.model.hand;
  const auto hz = [](double v) { return ui::number(v, 0) + " Hz"; };
  if (!c.model.replay.on) {
    ui::stat("Haptics", hz(hand.haptic.rate_hz),
             "Haptic ticks per second, over a quarter second; the target for firm contact is 1000",
             is_slow(hand) ? color::kAmber : color::kText);
    ui::stat("Physics", hz(hand.physics.rate_hz),
             "Steps of the bones' motion per second; the target is 500");
  }
  ui::stat("Picture", hz(hand.picture_hz), "Pictures per second; the display sets the limit");
  if (c.model.replay.on) return;
  ui::stat("Tick, 99 %", ui::number(hand.haptic.p99_us, 0) + " \xC2\xB5s",
           "99 % of the haptic ticks took at most this long, microseconds; the limit is 1000");
  ui::stat("Missed ticks", std::to_string(hand.haptic.missed),
           "Haptic ticks skipped because the computer was busy, since the run began");
  if (has_motors(hand))
    ui::stat("Device limit", ui::number(hand.info.peak_force_n, 1) + " N",
             "Greatest force that the device may give, newtons; from its profile");
}

// In sight whatever is folded.
void draw_warnings(const PanelContext& c) {
  const HandModel& hand = c.model.hand;
  if (c.model.replay.on) return;
  if (is_slow(hand)) {
    ui::text(color::kAmber, "! The haptic loop is slow");
    ui::tooltip(
        "Fewer than 950 haptic ticks per second: contact feels soft. Close other programs.");
  }
  if (hand.realtime_warning.empty()) return;
  // The first sentence names what is missing; the check-up says the same.
  const std::string what = hand.realtime_warning.substr(0, hand.realtime_warning.find('.'));
  ImGui::PushTextWrapPos(0);
  ui::text(color::kAmber, ("! " + what).c_str());
  ImGui::PopTextWrapPos();
  ui::tooltip(hand.realtime_warning.c_str());
}

}  // namespace

void draw_hand_card(const PanelContext& c) {
  const UiRect& r = c.layout.right;
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSizeConstraints({r.w, 0}, {r.w, r.h});
  begin_panel("##hand", kCardPanel);
  if (ui::section(c.fonts, "Hand")) {
    draw_device_menu(c);
    draw_force_state(c);
    draw_hands(c);
    draw_force_section(c);
    draw_contacts(c);
  }
  if (has_motors(c.model.hand) && !c.model.replay.on && ui::section(c.fonts, "Device"))
    draw_device_section(c);
  if (ui::section(c.fonts, "Feel", !has_motors(c.model.hand))) draw_feel(c);
  if (ui::section(c.fonts, "Rates", !has_motors(c.model.hand))) draw_rates(c);
  draw_warnings(c);
  ImGui::End();
}

}  // namespace osteon
