#pragma once

#include <imgui.h>

#include "ui/toasts.h"

namespace osteon::ui {

/// A small window of its own that takes no focus and keeps no settings.
inline constexpr ImGuiWindowFlags kNoteFlags =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
    ImGuiWindowFlags_NoNav;

/// Where a message is drawn: the middle of its upper edge, and the width at which it wraps, pixels.
struct ToastPlace {
  float x = 0, y = 0, wrap = 0;
  float scale = 1;
  ImFont* strong = nullptr;  ///< for its sign
};

/// Draws a message. Returns the next one's y; `closed` becomes true when it is closed by a click.
float draw_toast_card(const Toast& toast, const ToastPlace& at, bool& closed);

}  // namespace osteon::ui
