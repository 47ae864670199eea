#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "loops/runtime.h"
#include "osteon/device/pad_device.h"
#include "runs/contact_timeline.h"
#include "runs/device_choices.h"
#include "runs/force_history.h"
#include "runs/probe_drag.h"

namespace osteon {

class MouseDevice;

/// How a run shall feel.
struct FeelSettings {
  double stiffness_n_per_m = 2000;
  double friction_scale = 1;
  bool bones_held = true;
};

/// The session's settings for a device: its profile's limits, the user's wishes within them. A
/// device without motors gets the limits of a teaching device, so that its force can be shown. A
/// hand that moves the tool by `scale` times its own way feels a coupling stiffer by as much.
SessionSettings settings_for(const DeviceInfo& info, const FeelSettings& feel, double scale = 1);

/// A live case in the window: the runtime, what the hand holds, the recording. Every change of
/// device and every start of a recording is a new run (a recording begins with its session).
class LiveRun {
 public:
  LiveRun(std::shared_ptr<const Case> the_case, std::string case_source, ProbePath demo,
          const FeelSettings& feel);

  /// From the next opening on, the last seconds of a device with motors go to this file when it is
  /// closed.
  void keep_force_log(std::filesystem::path file) { force_log_ = std::move(file); }
  /// Starts anew with this device, used as `user` says. `X_WD_start`: where a device without a pose
  /// of its own is; the middle of another's workspace is put there, with its axes tied to the
  /// camera's (`q_WC`) or to the patient's.
  Result<void> start(const DeviceChoice& choice, const Pose& X_WD_start,
                     const MappingSettings& user = {}, const Quat& q_WC = Quat::Identity());
  /// Starts anew with the same device where the probe is, used in another way.
  Result<void> change_mapping(const MappingSettings& user, const Quat& q_WC);
  Result<void> start_recording(const std::filesystem::path& file);
  /// Ends the recording; the run starts anew where the probe is.
  Result<void> stop_recording();
  /// Ends the run for good: zero force, a closed device, the recording whole.
  Result<void> end();
  /// Takes in what the loops reported. Once a frame.
  void update();

  /// Ends the run and hands its device out for a check-up, open and at zero force; null where none
  /// is held. The run stands still until `take_back`. Not while recording.
  std::unique_ptr<HapticDevice> lend_device();
  /// Goes on where the probe was. The force is on again only if it was on before.
  Result<void> take_back(std::unique_ptr<HapticDevice> device);

  void set_feel(const Command& command);
  void set_force(bool on);
  bool force_wanted() const { return force_on_; }
  void calibrate();
  /// A device that a hand moves, not one that plays or is drawn on the screen.
  bool by_real_device() const;
  const MappingSettings& mapping_settings() const { return user_; }
  /// The mouse moves its hand; no effect with another device.
  void move_hand(const ProbeMotion& motion, const Camera& camera, const Viewport& viewport,
                 double dt_s);
  /// Pedals and the camera, once a frame: a dead-man pedal that is not told again counts as let go.
  void tell_hand(HandWishes pedals, const Camera& camera);
  /// The gamepad's sticks, as seen by the camera.
  void move_pad(const PadAxes& axes_C, const Camera& camera);

  const RenderSnapshot& snapshot() const { return snapshot_; }
  const DeviceStatus& device_status() const { return device_status_; }
  const LoopStats& haptic_stats() const { return haptic_stats_; }
  const LoopStats& physics_stats() const { return physics_stats_; }
  const FeelSettings& feel() const { return feel_; }
  const DeviceChoice& choice() const { return choice_; }
  const ForceHistory& force() const { return force_; }
  const ContactTimeline& contacts() const { return contacts_; }
  double force_limit_n() const { return settings_.haptic.max_force_n; }
  bool recording() const { return recording_; }
  const std::filesystem::path& recording_file() const { return recording_file_; }
  /// Why the recording ended by itself; empty otherwise. Given once.
  std::string take_recording_failure();
  std::string realtime_warning() const;
  /// The mouse holds the probe in this run.
  bool by_mouse() const { return mouse_ != nullptr; }

 private:
  Result<void> start_run(const Pose& X_WD_start, std::unique_ptr<RecordFeed> feed);
  Result<std::unique_ptr<HapticDevice>> device_for_next_run();
  DeviceMapping mapping_at(const Pose& X_WD_start, HapticDevice& device) const;
  void end_run();
  Pose probe_now() const;
  RecordingHeader header() const;

  std::shared_ptr<const Case> case_;
  std::string case_source_;
  ProbePath demo_;
  FeelSettings feel_;
  DeviceChoice choice_;
  DeviceInfo opened_;  ///< of the device of the run
  SessionSettings settings_;
  DeviceMapping mapping_;
  MappingSettings user_;
  Quat q_WC_ = Quat::Identity();
  std::string device_driver_, device_serial_;  ///< of runtime_'s device
  Pose X_WD_wanted_;
  std::unique_ptr<Runtime> runtime_;
  std::unique_ptr<HapticDevice> held_;  ///< between two runs
  bool same_device_ = false;            ///< as in the run before
  ForceOff tripped_ =
      ForceOff::kNone;            ///< by a fault in the run before: the user re-arms, no other
  MouseDevice* mouse_ = nullptr;  ///< of runtime_, when it is one
  PadDevice* pad_ = nullptr;
  bool force_on_ = true;
  bool recording_ = false;
  std::filesystem::path recording_file_;
  std::filesystem::path force_log_;
  std::string recording_failure_;
  RenderSnapshot snapshot_;
  DeviceStatus device_status_;
  LoopStats haptic_stats_, physics_stats_;
  ForceHistory force_;
  ContactTimeline contacts_;
};

}  // namespace osteon
