#include "ui/camera_control.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {
constexpr double kFlight_s = 0.25;
constexpr double kRadiansPerHeight = 3.2;  // a drag over the picture's height turns by this
constexpr double kWheelFactor = 0.88;
constexpr double kKeyTurn_rad_per_s = 1.6;
constexpr double kKeyZoomPerS = 0.35;
constexpr double kClickTravel_px = 4;
}  // namespace

Camera between(const Camera& from, const Camera& to, double share) {
  Camera camera = to;
  camera.target_W = from.target_W + share * (to.target_W - from.target_W);
  camera.distance_m = from.distance_m * std::pow(to.distance_m / from.distance_m, share);
  camera.q_WC = from.q_WC.slerp(share, to.q_WC);
  return camera;
}

void CameraControl::fly_to(const Camera& from, const Camera& to) { flight_ = Flight{from, to, 0}; }

Camera CameraControl::flown(double dt_s) {
  flight_->time_s += dt_s;
  const double t = std::clamp(flight_->time_s / kFlight_s, 0.0, 1.0);
  const Camera camera = between(flight_->from, flight_->to, t * t * (3 - 2 * t));
  if (t >= 1) flight_.reset();
  return camera;
}

void CameraControl::track_buttons(const SceneInput& input) {
  const bool down = input.left || input.middle || input.right;
  clicked_ = false;
  if (down && !was_down_) {
    pressed_on_panel_ = input.over_panels;
    moved_px_ = 0;
    drag_ = input.left && !input.shift ? Drag::kOrbit : Drag::kPan;
  } else if (down) {
    moved_px_ += std::abs(input.dx) + std::abs(input.dy);
  } else if (was_down_) {
    clicked_ = drag_ == Drag::kOrbit && moved_px_ < kClickTravel_px && !pressed_on_panel_;
    drag_ = Drag::kNone;
  }
  was_down_ = down;
  dragging_ = down && !pressed_on_panel_ && moved_px_ >= kClickTravel_px;
}

Camera CameraControl::update(const Camera& camera, const SceneInput& input,
                             const Viewport& viewport) {
  track_buttons(input);
  const double height = std::max(1, viewport.height);
  const bool drags = dragging_ && (input.dx != 0 || input.dy != 0);
  const bool wheels = input.wheel != 0 && !input.over_panels;
  const bool keys = input.turn_right != 0 || input.turn_up != 0 || input.zoom_in != 0;
  if (flight_ && !drags && !wheels && !keys) return flown(input.dt_s);
  if (!drags && !wheels && !keys) return camera;

  flight_.reset();
  Camera moved = camera;
  if (drags && drag_ == Drag::kOrbit)
    moved = orbit(moved, axis_W_, kRadiansPerHeight * input.dx / height,
                  -kRadiansPerHeight * input.dy / height);
  if (drags && drag_ == Drag::kPan) moved = pan(moved, input.dx / height, -input.dy / height);
  if (wheels) moved = zoom(moved, std::pow(kWheelFactor, input.wheel));
  if (keys) {
    moved = orbit(moved, axis_W_, kKeyTurn_rad_per_s * input.dt_s * input.turn_right,
                  kKeyTurn_rad_per_s * input.dt_s * input.turn_up);
    moved = zoom(moved, std::pow(kKeyZoomPerS, input.zoom_in * input.dt_s));
  }
  return moved;
}

}  // namespace osteon
