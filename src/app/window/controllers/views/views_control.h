#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "window/controllers/sessions/hands_control.h"
#include "window/controllers/sessions/replay_control.h"
#include "window/controllers/views/moving_detail.h"
#include "window/controllers/views/observer_control.h"
#include "window/controllers/views/soft_picture.h"

namespace osteon {

/// Draws the picture's views of the scene as it stands; see PictureViews for what is in them.
class ViewsControl {
 public:
  ViewsControl(WindowHost& host, ShownCase& scene, SceneSight& sight, LiveControl& live,
               ReplayControl& replay, HandsControl& hands, ObserverControl& observer)
      : host_(host),
        scene_(scene),
        sight_(sight),
        live_(live),
        replay_(replay),
        hands_(hands),
        observer_(observer) {}

  /// The renderer was given its surfaces anew, as they are at rest.
  void draw_softs_again() { softs_.begin_again(); }
  /// `looks` of the view from outside.
  void draw(const ViewState& looks);
  /// The work of the picture drawn last, seconds; a still that will be saved is never coarser.
  void picture_took(double picture_s);
  void apply(const ViewsRequests& requests);
  ViewsModel model() const;
  /// What is on show now.
  FilmMoment moment() const;

 private:
  std::vector<ToolState> others() const;
  CarvedPicture* carved();  ///< null: nothing is carved
  void show_carved();
  void show_heat(CarvedPicture& picture);
  void show_softs();
  Viewport xray_viewport(const Pane& pane) const;
  void keep_still();
  void set_pump_again();
  std::optional<WaterModel> water_model() const;
  std::string message_on(PaneKind kind) const;

  WindowHost& host_;
  ShownCase& scene_;
  SceneSight& sight_;
  LiveControl& live_;
  ReplayControl& replay_;
  HandsControl& hands_;
  ObserverControl& observer_;
  std::pair<std::uint64_t, std::uint64_t> carved_run_;  ///< whose cuts the renderer shows
  double carved_s_ = 0;                                 ///< when they were shown last
  double heat_s_ = 0;                                   ///< likewise of temperatures
  SoftPicture softs_;
  MovingDetail detail_;
  std::optional<WaterSettings> pump_;                 ///< as the user has set it
  std::pair<std::uint64_t, std::uint64_t> pump_run_;  ///< that was told
};

}  // namespace osteon
