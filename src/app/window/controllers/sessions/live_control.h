#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runs/hands/device_choices.h"
#include "runs/hands/live_run.h"
#include "window/controllers/sessions/instrument_tray.h"
#include "window/controllers/sessions/pedal_control.h"
#include "window/controllers/views/scene_sight.h"

namespace osteon {

struct UiModel;

/// The live run of the case on show: its devices, its tray, how it feels, its recording.
class LiveControl {
 public:
  LiveControl(WindowHost& host, ShownCase& scene, SceneSight& sight)
      : host_(host), scene_(scene), sight_(sight), pedals_(host) {}

  /// Reads which devices there are.
  void list_devices();
  /// Null: a replay is on show, or nothing is.
  LiveRun* run() const { return run_.get(); }
  bool recording() const { return run_ && run_->recording(); }
  /// Tells one LiveRun of this window from the next.
  std::uint64_t runs_made() const { return runs_made_; }
  InstrumentTray& tray() { return tray_; }
  const InstrumentTray& tray() const { return tray_; }

  /// Instruments that the tray has whatever the case's region is.
  const std::vector<std::string>& wanted_instruments() const { return wanted_; }
  void want_instrument(const std::string& name) { wanted_.push_back(name); }
  /// The tray of the case on show, made beside the window.
  void take_tray(PreparedTray tray);

  /// The first run after something was opened: what the command line ordered counts once.
  void begin();
  /// With the device of that key.
  void start(const std::string& device);
  /// Hands with a name, an instrument of the tray ("" is the wrist probe) and a place each. One
  /// device serves all of them by turns; hands by mouse have a mouse each.
  struct PlacedHand {
    std::string name, instrument;
    Pose X_WD;
  };
  Result<void> start_placed(const std::vector<PlacedHand>& hands);
  void drop();

  /// The pointer is the probe's while it is held.
  bool probe_held() const { return probe_held_; }
  bool probe_toggled() const { return probe_toggled_; }
  void hold_probe(bool held);
  void let_probe_go() { probe_toggled_ = false; }

  /// Once a picture: tells the hands' wishes, takes in what the loops reported. `power_key`: the
  /// key for what the hand holds is down.
  void update(bool power_key, double dt_s);
  /// `may_resume`: nothing but the user's wish keeps the force off.
  void apply_feel(const UiRequests& requests, bool may_resume);
  void bring_into_picture();
  /// Not while a check-up may have the device.
  void apply_device(const UiRequests& requests);
  void toggle_recording();
  /// Ends the run for good.
  Result<void> end() { return run_ ? run_->end() : Result<void>(); }
  void remember_feel();
  void describe(UiModel& model) const;

 private:
  void make_tray();
  void make_run();
  bool start_ordered(const std::vector<std::string>& devices);
  MappingSettings mapping_for(const DeviceChoice& choice) const;
  void apply_mapping(const UiRequests& requests);

  WindowHost& host_;
  ShownCase& scene_;
  SceneSight& sight_;
  PedalControl pedals_;
  std::vector<DeviceChoice> choices_;
  std::vector<std::string> wanted_;
  InstrumentTray tray_;
  std::string tray_region_;  ///< what `tray_` was made of
  std::vector<std::string> tray_wanted_;
  std::unique_ptr<LiveRun> run_;
  std::uint64_t runs_made_ = 0;
  double mapping_changed_s_ = -1;  ///< not yet in effect; -1: it is
  bool probe_held_ = false;        ///< now
  bool probe_toggled_ = false;     ///< by a key, stays
};

}  // namespace osteon
