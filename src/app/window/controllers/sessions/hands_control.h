#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "osteon/device/inkwell.h"
#include "window/controllers/sessions/live_control.h"
#include "window/controllers/sessions/tip_gauge.h"
#include "window/hands_model.h"
#include "window/pictures/tray_pictures.h"

namespace osteon {

/// Who holds what and where the hands go: two hands, the tray, portals, the way back; and where
/// the tip is to the bones.
class HandsControl {
 public:
  HandsControl(WindowHost& host, ShownCase& scene, SceneSight& sight, LiveControl& live)
      : host_(host), scene_(scene), sight_(sight), live_(live) {}

  /// Another case is on show.
  void begin_case();
  /// Something else is on show, of the same case perhaps.
  void begin_run() { aimed_.reset(); }
  void close_tray() { tray_open_ = false; }
  bool tray_open() const { return tray_open_; }

  /// `free`: hands may take and move things. True: the user went back to a mark.
  bool apply(const HandsRequests& requests, bool free);
  /// The active hand takes what stands at this place of the tray.
  void take(std::uint32_t place);
  /// With Alt held, wheel and turning keys are the resting hand's: true, and taken from `input`.
  bool nudge_rested(SceneInput& input);
  /// The portal that leads the active hand; none: no portal does.
  std::optional<Vec3> portal_near() const;
  /// Buttons of the active hand's device, once a picture.
  void poll_buttons();

  /// `used`: what an exercise has the active hand use, by the tray's names.
  HandsModel model(bool can_add, const std::vector<std::string>& used = {});

 private:
  void exchange(const HandsRequests& requests);
  void change_hands();
  const Tool* tool_at(std::uint32_t place) const;  ///< of the tray; null: it has none there
  /// A portal that a hand may be brought to: one of the case that is open, or one that was made.
  struct WayIn {
    std::size_t portal = 0;  ///< in ShownCase::portals
    Vec3 p_W = Vec3::Zero(), inwards_W = Vec3::UnitZ();
  };
  std::vector<WayIn> ways_in() const;
  std::size_t free_way(std::span<const WayIn> ways, std::size_t from) const;
  void stand_upright();
  void bring_to(std::size_t way);
  std::vector<HandRow> rows() const;
  TrayModel tray_model(const std::vector<std::string>& used) const;
  TipModel tip_model();
  std::vector<NameTag> name_tags() const;

  WindowHost& host_;
  ShownCase& scene_;
  SceneSight& sight_;
  LiveControl& live_;
  TrayPictures pictures_;
  bool tray_open_ = false, names_on_ = false;
  std::string search_;
  std::optional<WayIn> aimed_;        ///< portal that a hand was brought to
  std::uint32_t buttons_before_ = 0;  ///< of the active hand's device
  InkwellVisits inkwell_;             ///< of that device's stylus
  TipGauge tip_;
};

}  // namespace osteon
