#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "osteon/base/clock.h"
#include "ui/app_settings.h"
#include "ui/gl_window.h"
#include "ui/imgui_host.h"
#include "ui/toasts.h"
#include "ui/ui_layout.h"
#include "window/window_order.h"

namespace osteon {

/// What every controller may use: the window itself, the user's settings, notices, the time, and
/// what the command line ordered. An order that has been carried out is taken out of it.
struct WindowHost {
  explicit WindowHost(const WindowOrder& ordered) : order(ordered), created_ns(steady_now_ns()) {}

  struct Pixels {
    int width = 0, height = 0;
  };
  Pixels pixels() const {
    Pixels size;
    window->framebuffer_size(size.width, size.height);
    return size;
  }
  /// As make_layout takes it.
  float left_card() const {
    const auto wanted = static_cast<float>(settings.left_card);
    return exercise_runs ? std::max(wanted, kExerciseCard) : wanted;
  }
  void note(ToastKind kind, const std::string& text) { toasts.add(kind, text, now_s); }
  /// Since the program began.
  double age_s() const { return 1e-9 * static_cast<double>(steady_now_ns() - created_ns); }

  WindowOrder order;
  std::int64_t created_ns = 0;
  AppSettings settings;
  std::optional<GlWindow> window;
  std::unique_ptr<ImGuiHost> ui;
  Toasts toasts;
  double now_s = 0;  ///< since the loop began
  bool exercise_runs = false;
};

}  // namespace osteon
