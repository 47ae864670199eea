#pragma once

#include <vector>

#include "ui/ui_theme.h"

struct GLFWwindow;

namespace osteon {

/// The ImGui context of a window with its two backends. The window must outlive it.
class ImGuiHost {
 public:
  ImGuiHost(GLFWwindow* window, float scale);
  ~ImGuiHost();
  ImGuiHost(const ImGuiHost&) = delete;
  ImGuiHost& operator=(const ImGuiHost&) = delete;

  /// Loads fonts and theme for another scale; nothing when it is the same.
  void set_scale(float scale);
  float scale() const { return scale_; }
  const UiFonts& fonts() const { return fonts_; }
  /// The pointer belongs to the picture while the probe is held.
  void take_pointer(bool taken);
  /// `pressed_keys` went down since the last frame: each is seen for a frame at least, however
  /// short it was.
  void begin_frame(const std::vector<int>& pressed_keys);
  /// Draws into the framebuffer that is bound.
  void end_frame();

 private:
  void choose_atlas_filter();

  UiFonts fonts_;
  float scale_ = 0;
  bool atlas_ready_ = false;     ///< the filter of the font texture is chosen
  std::vector<int> short_keys_;  ///< shown as down in the last frame though they were up
};

}  // namespace osteon
