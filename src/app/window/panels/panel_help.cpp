#include <algorithm>
#include <array>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

struct KeyLine {
  const char* keys;
  const char* what;
};

constexpr std::array<KeyLine, 13> kLook = {{
    {"Drag", "look around"},
    {"Right drag, Shift + drag", "move sideways"},
    {"Wheel", "zoom in, out"},
    {"Arrows,  + and -", "the same with keys"},
    {"1 to 6", "the six views, as in the panel"},
    {"F", "close up on the chosen bone or the joint"},
    {"Click", "choose a bone"},
    {"H", "contact hulls"},
    {"L", "names on the bones"},
    {"V, F5 to F9", "next view; outside, scope, panorama, all, X-ray"},
    {"B, C", "take an X-ray picture; save the scope's picture"},
    {"F3", "second window for observers"},
    {"Tab", "fold the panels away"},
}};

constexpr std::array<KeyLine, 18> kProbe = {{
    {"M", "take or release the instrument"},
    {"Space", "hold it while the key is down"},
    {"Mouse, wheel", "move it; deeper, nearer"},
    {"W S, A D, Q E", "tilt, turn, roll"},
    {"Shift + Q E, + wheel", "turn about its shaft; finer steps"},
    {"Ctrl + wheel", "push it on along its shaft, draw it back"},
    {"Z", "upright on what its tip is nearest to"},
    {"Y, Shift + Y", "as the expert holds it; and to where he has it"},
    {"X", "the other hand"},
    {"G", "move it to the next portal; the wheel goes in"},
    {"Alt + wheel, Q E, W S A D", "the resting hand: along, about, tilt"},
    {"Gamepad", "the same; hold B where it moves your hand"},
    {"T", "tray of instruments"},
    {"Page Up, Page Down, End", "previous, next instrument; next size"},
    {"V", "hold: the motor runs, the jaws close"},
    {"K, U", "mark this moment, go back to it"},
    {"Esc", "force off at once"},
    {"Enter", "force on again"},
}};

constexpr std::array<KeyLine, 4> kEdit = {{
    {"E", "edit the chosen bone's surface, or leave"},
    {"Drag, wheel", "pull the surface; along the view"},
    {"The device's button", "the same by hand, against a spring force"},
    {"Ctrl + Z, + Shift", "undo, redo"},
}};

constexpr std::array<KeyLine, 7> kRun = {{
    {"R", "record, stop"},
    {"F4", "film of this window, stop"},
    {"O, Ctrl + O", "open a case, recording, meshes or a scan"},
    {"N", "make a new patient"},
    {"J, I", "exercises, or end one; a hint"},
    {"P", "play, pause a replay; pause an exercise"},
    {",  .", "slower, faster"},
}};

constexpr std::array<KeyLine, 6> kProgram = {{
    {"F2", "check this computer and its devices"},
    {"F11", "full screen"},
    {"F12, Shift + F12", "picture of the window, of the scene alone"},
    {"Ctrl + and Ctrl -", "larger, smaller interface"},
    {"Ctrl + Tab", "reach the panels by keyboard"},
    {"Ctrl + Q", "quit"},
}};

template <std::size_t N>
void draw_keys(const PanelContext& c, const char* title, const std::array<KeyLine, N>& lines) {
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted(title);
  }
  if (!ImGui::BeginTable(title, 2, ImGuiTableFlags_SizingFixedFit)) return;
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, c.px(176));
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, c.px(270));
  for (const KeyLine& line : lines) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ui::text(color::kAccent, line.keys);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(line.what);
  }
  ImGui::EndTable();
  ImGui::Dummy({0, c.px(4)});
}

}  // namespace

void draw_help(const PanelContext& c) {
  const UiRect& r = c.layout.picture;
  // Two columns of about the same length where there is room, else one that scrolls; Close stays
  // in sight.
  const bool wide = r.w > c.px(1000);
  const float w = std::min(wide ? c.px(980) : c.px(520), r.w - c.px(16));
  const float h = std::min(wide ? c.px(600) : c.px(680), r.h - c.px(16));
  ImGui::SetNextWindowPos({r.x + r.w / 2, r.y + r.h / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({w, h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(24), c.px(16)});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(0x1c, 0x20, 0x25, 0xff));
  ImGui::PushStyleColor(ImGuiCol_ChildBg, 0);
  ImGui::Begin(
      "##help", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::BeginChild("keys", {0, -ImGui::GetFrameHeightWithSpacing() - c.px(4)});
  if (wide) ImGui::Columns(2, nullptr, false);
  draw_keys(c, "Look", kLook);
  draw_keys(c, "Edit", kEdit);
  draw_keys(c, "Program", kProgram);
  if (wide) ImGui::NextColumn();
  draw_keys(c, "Instruments and hands", kProbe);
  draw_keys(c, "Run", kRun);
  if (wide) ImGui::Columns(1);
  ImGui::EndChild();
  if (ImGui::Button("Close  (F1)")) c.requests.toggle_help = true;
  ImGui::End();
  ImGui::PopStyleColor(2);
  ImGui::PopStyleVar();
}

}  // namespace osteon
