#include <algorithm>
#include <string>

#include "ui/panel_ground.h"
#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

void draw_title(const PanelContext& c) {
  const float row = c.px(5);
  ImGui::SetCursorPos({c.px(16), row + c.px(6)});
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted(c.model.case_title.empty() ? "Osteon" : c.model.case_title.c_str());
  }
  // A narrow bar has no room for more.
  if (c.model.activity.empty() || c.layout.top.w < c.px(960)) return;
  ImGui::SameLine(0, c.px(16));
  ui::text(color::kTextQuiet, c.model.activity.c_str());
}

void draw_record_button(const PanelContext& c) {
  const RecordModel& record = c.model.record;
  ImGui::BeginDisabled(c.model.replay.on || c.model.phase != UiPhase::kReady);
  const char* label = record.on ? "      Stop###record" : "      Record###record";
  if (ui::toggle_button(label, record.on)) c.requests.toggle_record = true;
  const ImVec2 lo = ImGui::GetItemRectMin();
  const ImVec2 hi = ImGui::GetItemRectMax();
  ImGui::EndDisabled();
  ui::tooltip(record.on ? "Ends the recording and saves the file (R)"
                        : "Records this run to a file that replays exactly (R). The run restarts "
                          "from the hand's current position.");
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 at{lo.x + c.px(16), 0.5f * (lo.y + hi.y)};
  const float r = c.px(5);
  // A square while recording, so that the state does not hang on the colour.
  if (record.on)
    draw->AddRectFilled({at.x - r, at.y - r}, {at.x + r, at.y + r}, color::kRed, 1);
  else
    draw->AddCircleFilled(at, r, color::kRed);
}

void draw_exercise_button(const PanelContext& c) {
  if (ui::toggle_button("Exercises", c.model.exercise.page != ExercisePage::kClosed))
    c.requests.exercise.toggle = true;
  ui::tooltip("Exercises that are judged (J)");
}

void draw_open_button(const PanelContext& c) {
  if (ui::toggle_button("Open", c.model.browser.open)) c.requests.browser.toggle = true;
  ui::tooltip(
      "Cases, patients, recordings, meshes and scans (O). You can also drop files on the window.");
}

// Width of the buttons and the time, so that they end at the right edge.
float right_part_width(const PanelContext& c) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const auto button = [&style](const char* label) {
    return ImGui::CalcTextSize(label).x + 2 * style.FramePadding.x;
  };
  float width = ImGui::CalcTextSize("00:00.0").x + c.px(16);
  width += button(c.model.record.on ? "      Stop" : "      Record") + style.ItemSpacing.x;
  width += button("Exercises") + style.ItemSpacing.x;
  width += button(film_label(c.model.views.film).c_str()) + style.ItemSpacing.x;
  width += button("Open") + style.ItemSpacing.x + button("Help");
  if (c.model.replay.on) width += button("Leave replay") + style.ItemSpacing.x;
  return width + c.px(16);
}

// In the bar's middle where title and actions leave room for it, else beside the actions.
void draw_chooser(const PanelContext& c) {
  const UiRect& r = c.layout.top;
  ImGui::SameLine(0, 0);
  const float from = ImGui::GetCursorPosX() + c.px(24);
  const float to = r.w - right_part_width(c) - c.px(24);
  const bool wide = to - from >= layout_chooser_width(c, true);
  const float w = layout_chooser_width(c, wide);
  const float middle = 0.5f * (r.w - w);
  ImGui::SetCursorPos({std::max(std::min(std::max(middle, from), to - w), 0.0f),
                       0.5f * (r.h - ImGui::GetFrameHeight())});
  draw_layout_chooser(c, wide);
}

void draw_actions(const PanelContext& c) {
  const std::string time =
      c.model.record.on ? ui::clock_time(c.model.record.seconds) : ui::clock_time(c.model.time_s);
  ui::text(c.model.record.on ? color::kText : color::kTextQuiet, time.c_str());
  ui::tooltip(c.model.record.on
                  ? "Length of the recording so far, minutes and seconds"
                  : "Simulated time since the start of this run, minutes and seconds");
  ImGui::SameLine(0, c.px(16));
  draw_record_button(c);
  ImGui::SameLine();
  draw_exercise_button(c);
  ImGui::SameLine();
  draw_film_button(c);
  ImGui::SameLine();
  draw_open_button(c);
  if (c.model.replay.on) {
    ImGui::SameLine();
    if (ImGui::Button("Leave replay")) c.requests.close_replay = true;
    ui::tooltip("Back to the live case");
  }
  ImGui::SameLine();
  if (ui::toggle_button("Help", c.model.help_open)) c.requests.toggle_help = true;
  ui::tooltip("All keys (F1)");
}

}  // namespace

void draw_top_bar(const PanelContext& c) {
  const UiRect& r = c.layout.top;
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSize({r.w, r.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  begin_panel("##top", kBarPanel);
  ImGui::PopStyleVar(2);
  draw_title(c);
  if (c.model.phase == UiPhase::kReady) draw_chooser(c);
  ImGui::SetCursorPos({r.w - right_part_width(c), 0.5f * (r.h - ImGui::GetFrameHeight())});
  ImGui::AlignTextToFramePadding();
  draw_actions(c);
  ImGui::End();
}

}  // namespace osteon
