#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>

#include "window/panels/panels.h"

namespace osteon {
namespace {

bool pressed(int key) { return ImGui::IsKeyPressed(key, false); }

void read_view_keys(const PanelContext& c) {
  static constexpr std::array<ViewPreset, 6> kPresets = {ViewPreset::kDorsal, ViewPreset::kPalmar,
                                                         ViewPreset::kRadial, ViewPreset::kUlnar,
                                                         ViewPreset::kAp,     ViewPreset::kLateral};
  for (int i = 0; i < 6; ++i)
    if (pressed(GLFW_KEY_1 + i)) c.requests.preset = kPresets[static_cast<std::size_t>(i)];
  if (pressed(GLFW_KEY_F)) c.requests.close_up = true;
  if (pressed(GLFW_KEY_H)) {
    c.requests.view = c.model.view;
    c.requests.view->show_hulls = !c.model.view.show_hulls;
  }
}

void read_window_keys(const PanelContext& c) {
  const ImGuiIO& io = ImGui::GetIO();
  if (pressed(GLFW_KEY_F1)) c.requests.toggle_help = true;
  if (pressed(GLFW_KEY_F2)) c.requests.toggle_checkup = true;
  if (pressed(GLFW_KEY_F11)) c.requests.toggle_fullscreen = true;
  if (pressed(GLFW_KEY_F12))
    (io.KeyShift ? c.requests.screenshot_picture : c.requests.screenshot_window) = true;
  if (pressed(GLFW_KEY_TAB) && !io.KeyCtrl) c.requests.toggle_panels = true;
  if (!io.KeyCtrl) return;
  if (pressed(GLFW_KEY_Q)) c.requests.quit = true;
  if (pressed(GLFW_KEY_EQUAL) || pressed(GLFW_KEY_KP_ADD)) c.requests.zoom_interface = 1.125;
  if (pressed(GLFW_KEY_MINUS) || pressed(GLFW_KEY_KP_SUBTRACT))
    c.requests.zoom_interface = 1 / 1.125;
}

void read_run_keys(const PanelContext& c) {
  const bool replay = c.model.replay.on;
  const bool running = c.model.exercise.page == ExercisePage::kRunning;
  if (pressed(GLFW_KEY_J)) (running ? c.requests.exercise.end : c.requests.exercise.toggle) = true;
  if (pressed(GLFW_KEY_I) && running) c.requests.exercise.hint = true;
  if (pressed(GLFW_KEY_P) && running) c.requests.exercise.pause = true;
  const bool briefing = c.model.exercise.page == ExercisePage::kBriefing;
  if (pressed(GLFW_KEY_ENTER) && briefing) c.requests.exercise.begin = true;
  if (pressed(GLFW_KEY_M) && c.model.hand.probe_by_mouse && !replay) c.requests.toggle_probe = true;
  // An exercise records by itself, and would end.
  if (pressed(GLFW_KEY_R) && !replay && !running) c.requests.toggle_record = true;
  if (pressed(GLFW_KEY_O)) c.requests.browser.toggle = true;
  if (pressed(GLFW_KEY_N)) c.requests.patient.toggle = true;
  if (pressed(GLFW_KEY_P) && replay) c.requests.toggle_play = true;
  if (pressed(GLFW_KEY_COMMA) && replay) c.requests.speed = std::max(0.1, c.model.replay.speed / 2);
  if (pressed(GLFW_KEY_PERIOD) && replay)
    c.requests.speed = std::min(4.0, c.model.replay.speed * 2);
  if (pressed(GLFW_KEY_ENTER) && c.model.hand.status.cause != ForceOff::kNone && !replay)
    c.requests.force_on = true;
}

}  // namespace

void read_shortcuts(const PanelContext& c) {
  // Off comes first and always works, whatever has the keyboard.
  if (pressed(GLFW_KEY_ESCAPE)) c.requests.force_off = true;
  // From the moment that the tray opens: its field has the keyboard a picture or two later, and a
  // word typed by then must not press keys.
  const bool tray = c.model.phase == UiPhase::kReady && c.model.hands.tray.open;
  if (tray) read_paging_keys(c);
  if (tray || ImGui::GetIO().WantTextInput) return;
  read_window_keys(c);
  if (c.model.phase != UiPhase::kReady) return;
  if (ImGui::GetIO().KeyCtrl) {
    if (pressed(GLFW_KEY_Z) && !c.model.edit.on) c.requests.hands.undo = true;
    if (pressed(GLFW_KEY_O)) c.requests.browser.toggle = true;
    return;
  }
  if (!c.model.hand.probe_in_hand) read_view_keys(c);
  read_layout_keys(c);
  read_run_keys(c);
  read_hand_keys(c);
}

}  // namespace osteon
