#pragma once

#include <optional>

#include "osteon/render/camera.h"
#include "ui/scene_input.h"

namespace osteon {

/// Turns pointer and keys into camera moves. Left drag orbits, right, middle or Shift drag pans,
/// the wheel zooms; a drag that began on a panel moves nothing. A preset is flown to in a quarter
/// second.
class CameraControl {
 public:
  /// `axis_W`: upright axis of the turntable, unit.
  explicit CameraControl(const Vec3& axis_W = Vec3::UnitZ()) : axis_W_(axis_W) {}
  Camera update(const Camera& camera, const SceneInput& input, const Viewport& viewport);
  /// True in the frame in which the left button was released without a drag.
  bool clicked() const { return clicked_; }
  bool dragging() const { return dragging_; }
  void fly_to(const Camera& from, const Camera& to);

 private:
  enum class Drag { kNone, kOrbit, kPan };
  struct Flight {
    Camera from, to;
    double time_s = 0;
  };
  void track_buttons(const SceneInput& input);
  Camera flown(double dt_s);

  Vec3 axis_W_;
  Drag drag_ = Drag::kNone;
  bool was_down_ = false;
  bool pressed_on_panel_ = false;
  bool dragging_ = false;
  bool clicked_ = false;
  double moved_px_ = 0;
  std::optional<Flight> flight_;
};

/// Between two cameras, `share` in [0, 1].
Camera between(const Camera& from, const Camera& to, double share);

}  // namespace osteon
