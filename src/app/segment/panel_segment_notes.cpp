#include <algorithm>
#include <array>
#include <string>

#include "segment/segment_panels.h"
#include "ui/panel_ground.h"
#include "ui/toast_card.h"
#include "ui/ui_widgets.h"

namespace osteon {
namespace {

void draw_bar(const SegmentContext& c, const LoadingModel& work) {
  ImGui::TextUnformatted(work.what.empty() ? "Starting" : work.what.c_str());
  if (!work.can_cancel) return;
  const float share = static_cast<float>(std::clamp(work.fraction, 0.0, 1.0));
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float w = c.px(336);
  ImGui::Dummy({w, c.px(6)});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(lo, {lo.x + w, lo.y + c.px(4)}, color::kField, c.px(2));
  draw->AddRectFilled(lo, {lo.x + w * share, lo.y + c.px(4)}, color::kAccent, c.px(2));
  std::string left = std::to_string(static_cast<int>(100 * share)) + " %";
  if (work.seconds_left >= 0)
    left += ", about " + std::to_string(static_cast<int>(work.seconds_left) + 1) + " s left";
  ui::text(color::kTextQuiet, left.c_str());
  ImGui::SameLine(c.px(16) + w - c.px(72));
  if (ImGui::Button("Cancel", {c.px(72), 0})) c.requests.cancel_job = true;
}

void begin_middle(const SegmentContext& c, const char* name, float up) {
  const UiRect& m = c.layout.middle;
  ImGui::SetNextWindowPos({m.x + m.w / 2, m.y + up * m.h}, ImGuiCond_Always, {0.5f, up});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(16), c.px(16)});
  ImGui::Begin(name, nullptr, ui::kNoteFlags);
  ImGui::PopStyleVar();
}

}  // namespace

void draw_segment_notes(const SegmentContext& c) {
  float y = c.layout.middle.y + c.px(32);
  const float x = c.layout.middle.x + c.layout.middle.w / 2;
  for (const Toast& toast : c.model.toasts) {
    bool closed = false;
    y = ui::draw_toast_card(toast, {x, y, c.px(400), c.px(1), c.fonts.strong}, closed);
    if (closed) c.requests.dismiss_toast = toast.id;
  }
  if (!c.model.job) return;
  const UiRect& m = c.layout.middle;
  ImGui::SetNextWindowPos({m.x + m.w / 2, m.bottom() - c.px(24)}, ImGuiCond_Always, {0.5f, 1});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(16), c.px(12)});
  ImGui::Begin("##job", nullptr, ui::kNoteFlags);
  ImGui::PopStyleVar();
  draw_bar(c, *c.model.job);
  ImGui::End();
}

void draw_segment_loading(const SegmentContext& c) {
  begin_middle(c, "##loading", 0.5f);
  if (c.model.phase == UiPhase::kLoading) {
    draw_bar(c, c.model.loading);
  } else {
    {
      const ui::WithFont strong(c.fonts.strong);
      ui::text(color::kAmber, "This could not be opened");
    }
    ImGui::PushTextWrapPos(c.px(420));
    ImGui::TextUnformatted(c.model.loading.failure.c_str());
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0, c.px(4)});
    if (ui::accent_button("Choose another scan")) c.requests.choose_scan = true;
    ImGui::SameLine(0, c.px(8));
    if (ImGui::Button(c.model.returns ? "Back to the simulator" : "Close"))
      c.requests.quit_without_saving = true;
  }
  ImGui::End();
}

void draw_close_question(const SegmentContext& c) {
  begin_middle(c, "##close", 0.5f);
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted("What you drew is not saved yet.");
  }
  ImGui::Dummy({c.px(320), c.px(4)});
  const float w = c.px(104);
  if (ui::accent_button("Save", {w, 0})) c.requests.quit_after_saving = true;
  ImGui::SameLine(0, c.px(4));
  if (ImGui::Button("Don't save", {w, 0})) c.requests.quit_without_saving = true;
  ImGui::SameLine(0, c.px(4));
  if (ImGui::Button("Stay", {w, 0}) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
    c.requests.stay = true;
  ImGui::End();
}

void draw_segment_top(const SegmentContext& c) {
  const UiRect& r = c.layout.top;
  ImGui::SetNextWindowPos({r.x, r.y});
  ImGui::SetNextWindowSize({r.w, r.h});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  begin_panel("##top", kBarPanel);
  ImGui::PopStyleVar(2);
  ImGui::SetCursorPos({c.px(14), 0.5f * (r.h - ImGui::GetTextLineHeight())});
  {
    const ui::WithFont strong(c.fonts.strong);
    ImGui::TextUnformatted(c.model.title.c_str());
  }
  ImGui::SameLine(0, c.px(16));
  ui::text(color::kTextQuiet, c.model.shape.c_str());
  if (c.model.changed) {
    ImGui::SameLine(0, c.px(16));
    ui::text(color::kAmber, "not saved");
  }
  const float help = ImGui::CalcTextSize("Help").x + 2 * ImGui::GetStyle().FramePadding.x;
  const float whole = ImGui::CalcTextSize("Whole slices").x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SetCursorPos({r.w - help - whole - c.px(22), 0.5f * (r.h - ImGui::GetFrameHeight())});
  if (ImGui::Button("Whole slices")) c.requests.fit_panes = true;
  ui::tooltip("Fits each slice to its view (F)");
  ImGui::SameLine(0, c.px(8));
  if (ui::toggle_button("Help", c.model.help_open)) c.requests.toggle_help = true;
  ui::tooltip("All keys (F1)");
  ImGui::End();
}

namespace {

struct HelpLine {
  const char* keys;
  const char* what;
};

constexpr std::array<HelpLine, 18> kHelp = {{
    {"Wheel", "through the slices"},
    {"Ctrl + wheel", "zoom in, out"},
    {"Right drag", "brightness and contrast"},
    {"Middle drag, Shift + right", "move the slice"},
    {"F", "whole slices"},
    {"C  G  B  X  S  M", "look, grow, paint, erase, split, merge"},
    {"[  ]", "thinner, thicker brush"},
    {"Ctrl + paint", "erase"},
    {"Shift + grow", "add to the chosen bone"},
    {"T", "threshold in the slices"},
    {"N", "new bone"},
    {"Ctrl + Z, + Shift", "undo, redo"},
    {"Ctrl + S", "save as a case"},
    {"Ctrl + O", "open the saved case in the simulator"},
    {"Tab", "fold the panels away"},
    {"F11", "full screen"},
    {"Ctrl + and Ctrl -", "larger, smaller interface"},
    {"Ctrl + Q", "quit"},
}};

}  // namespace

void draw_segment_help(const SegmentContext& c) {
  begin_middle(c, "##help", 0.5f);
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, c.px(190));
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, c.px(250));
    for (const HelpLine& line : kHelp) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ui::text(color::kAccent, line.keys);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(line.what);
    }
    ImGui::EndTable();
  }
  ImGui::Dummy({0, c.px(4)});
  if (ImGui::Button("Close  (F1)")) c.requests.toggle_help = true;
  ImGui::End();
}

}  // namespace osteon
