#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "osteon/base/result.h"

struct GLFWwindow;

namespace osteon {

struct WindowOptions {
  int width = 1280, height = 720;
  std::string title = "Osteon";
  bool within_screen = false;    ///< smaller where the first screen is
  bool wait_for_display = true;  ///< at most one picture a display refresh
  /// A window that is open: the new one shares its textures and buffers, and must end before it.
  GLFWwindow* beside = nullptr;
};

/// A window of the desktop with an OpenGL 3.3 context, current on the thread that made it. One at a
/// time, and others beside it.
class GlWindow {
 public:
  /// Fails in words when there is no display or no OpenGL 3.3.
  static Result<GlWindow> create(const WindowOptions& options);
  ~GlWindow();
  GlWindow(GlWindow&& other) noexcept;
  GlWindow& operator=(GlWindow&& other) noexcept;

  GLFWwindow* handle() const { return window_; }
  bool should_close() const;
  /// As what the user did was last taken in.
  void framebuffer_size(int& width, int& height) const;
  /// Scale of the display that the window is on; 1 is 96 dots an inch.
  float content_scale() const;
  /// Framebuffer pixels a screen coordinate, of that same moment.
  double pixel_ratio() const;
  /// Its name for other programs of the desktop, "x11:" and X11's number; empty: it has none.
  std::string name_for_desktop() const;
  void set_title(const std::string& title);
  void toggle_fullscreen();
  void close();
  /// Takes back a wish to close.
  void stay_open();
  /// Takes in what the user did.
  void poll() const;
  void swap() const;
  /// Keys (GLFW's numbers) that went down since the last call, also those that are up again.
  std::vector<int> take_pressed_keys();
  /// Files that the user dropped since the last call.
  std::vector<std::string> take_dropped_files();

 private:
  struct State;
  GlWindow() = default;
  void follow_size() const;
  GLFWwindow* window_ = nullptr;
  bool beside_ = false;  ///< another window's end is the display's
  std::unique_ptr<State> state_;
};

}  // namespace osteon
