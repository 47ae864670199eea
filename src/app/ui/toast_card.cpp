#include "ui/toast_card.h"

#include <string>

#include "ui/ui_widgets.h"

namespace osteon::ui {
namespace {

ImU32 color_of(ToastKind kind) {
  if (kind == ToastKind::kInfo) return color::kAccent;
  return kind == ToastKind::kWarning ? color::kAmber : color::kRed;
}

// The colour is not alone in telling kinds apart.
const char* sign_of(ToastKind kind) { return kind == ToastKind::kInfo ? "i" : "!"; }

}  // namespace

float draw_toast_card(const Toast& toast, const ToastPlace& at, bool& closed) {
  const float unit = at.scale;
  ImGui::SetNextWindowPos({at.x, at.y}, ImGuiCond_Always, {0.5f, 0});
  ImGui::PushStyleColor(ImGuiCol_Border, color_of(toast.kind));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {12 * unit, 8 * unit});
  ImGui::Begin(("##toast" + std::to_string(toast.id)).c_str(), nullptr, kNoteFlags);
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  {
    const WithFont strong(at.strong);
    text(color_of(toast.kind), sign_of(toast.kind));
  }
  ImGui::SameLine(0, 10 * unit);
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + at.wrap);
  ImGui::TextUnformatted(toast.text.c_str());
  ImGui::PopTextWrapPos();
  if (toast.kind != ToastKind::kInfo) {
    ImGui::SameLine(0, 16 * unit);
    if (ImGui::SmallButton("Close")) closed = true;
  }
  const float bottom = at.y + ImGui::GetWindowHeight();
  ImGui::End();
  return bottom + 8 * unit;
}

}  // namespace osteon::ui
