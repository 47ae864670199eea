#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "osteon/base/result.h"
#include "ui/gl_window.h"
#include "window/controllers/cases/shown_image.h"

namespace osteon {

/// A second window that shows a picture to whoever looks on, without controls: on a screen that the
/// first window is not on, where there is one. It shares the first one's graphics objects; that
/// one's context is current before and after every call.
class ObserverWindow {
 public:
  /// `own_screen` tells whether it has a screen for itself.
  static Result<std::unique_ptr<ObserverWindow>> open(const GlWindow& first, bool& own_screen);
  ~ObserverWindow();
  ObserverWindow(const ObserverWindow&) = delete;
  ObserverWindow& operator=(const ObserverWindow&) = delete;

  /// The user closed it.
  bool closed() const { return window_.should_close(); }
  /// True where it draws next: at most 30 times a second, and not while it is minimised.
  bool due(double now_s) const;
  void size(int& width, int& height) const { window_.framebuffer_size(width, height); }
  /// Shows what was drawn into `picture` in the first window's context.
  void show(const ShownImage& picture, double now_s);
  std::vector<int> take_pressed_keys() { return window_.take_pressed_keys(); }
  /// Its screen was unplugged: it goes to the one that is left. True where that happened.
  bool came_back();

 private:
  ObserverWindow(const GlWindow& first, GlWindow window);
  const GlWindow& first_;
  GlWindow window_;
  unsigned framebuffer_ = 0;  ///< in this window's context
  double shown_s_ = -1;
};

}  // namespace osteon
