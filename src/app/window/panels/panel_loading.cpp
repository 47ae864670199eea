#include <algorithm>
#include <string>

#include "ui/ui_widgets.h"
#include "window/panels/panels.h"

namespace osteon {
namespace {

void draw_progress(const PanelContext& c) {
  const LoadingModel& loading = c.model.loading;
  ImGui::TextUnformatted(loading.what.c_str());
  const float share = static_cast<float>(std::clamp(loading.fraction, 0.0, 1.0));
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float w = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({w, c.px(6)});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(lo, {lo.x + w, lo.y + c.px(4)}, color::kField, c.px(2));
  draw->AddRectFilled(lo, {lo.x + w * share, lo.y + c.px(4)}, color::kAccent, c.px(2));
  std::string left = std::to_string(static_cast<int>(100 * share)) + " %";
  if (loading.seconds_left >= 0)
    left += ", about " + std::to_string(static_cast<int>(loading.seconds_left) + 1) + " s left";
  ui::text(color::kTextQuiet, left.c_str());
  if (!loading.can_cancel) return;
  ImGui::SameLine(ImGui::GetWindowWidth() - c.px(88));
  if (ImGui::Button("Cancel", {c.px(72), 0})) c.requests.cancel_loading = true;
}

void draw_failure(const PanelContext& c) {
  {
    const ui::WithFont strong(c.fonts.strong);
    ui::text(color::kAmber, "This could not be opened");
  }
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(c.model.loading.failure.c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, c.px(4)});
  if (ui::accent_button("Open the built-in wrist")) c.requests.retry_loading = true;
}

}  // namespace

void draw_loading(const PanelContext& c) {
  const UiRect& r = c.layout.picture;
  ImGui::SetNextWindowPos({r.x + r.w / 2, r.y + r.h / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(c.px(400), r.w), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {c.px(16), c.px(16)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {c.px(8), c.px(8)});
  ImGui::Begin(
      "##loading", nullptr,
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  if (c.model.phase == UiPhase::kFailed)
    draw_failure(c);
  else
    draw_progress(c);
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace osteon
