#pragma once

#include <memory>
#include <vector>

#include "window/controllers/views/observer_window.h"
#include "window/controllers/views/scene_sight.h"

namespace osteon {

/// The second window, for who looks on.
class ObserverControl {
 public:
  ObserverControl(WindowHost& host, ShownCase& scene)
      : host_(host), scene_(scene), layout_(host.order.observer.value_or(PictureLayout::kScope)) {}

  void open();
  void toggle();
  void set_layout(PictureLayout layout) { layout_ = layout; }
  /// Once a picture. True: Esc was pressed there, the force goes off wherever the keyboard is.
  bool poll();
  /// Side of its scope's picture, px; 0: it shows none.
  int scope_px() const;
  /// `looks`: as the first window shows the bones.
  void draw(const ViewState& looks);
  ObserverModel model() const { return {observer_ != nullptr, layout_}; }

 private:
  std::vector<Pane> panes() const;

  WindowHost& host_;
  ShownCase& scene_;
  ShownImage picture_;
  std::unique_ptr<ObserverWindow> observer_;
  PictureLayout layout_;
};

}  // namespace osteon
