#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "loops/device_mapping.h"
#include "loops/haptic_stage.h"
#include "loops/loop_exchange.h"
#include "loops/physics_stage.h"
#include "loops/realtime.h"
#include "loops/record_feed.h"
#include "osteon/base/percentiles.h"

namespace osteon {

/// What a run is made of.
struct RunPlan {
  std::shared_ptr<const Case> the_case;
  SessionSettings settings;
  DeviceMapping mapping;
  MappingSettings mapping_settings;
  SafetyParams safety;
  bool force_enabled = true;
  /// Why the force is off where it is not enabled: a fault of the run before this one stays named.
  ForceOff off_because = ForceOff::kSoftware;
};

/// One run of a session with its loops: haptic (1 kHz) and physics (500 Hz), each on a thread of
/// its own, and a third that writes the recording. The window's thread talks to it through the
/// methods below; none of them waits for a loop but `stop`.
///
/// Without `start`, the `..._once` methods do the same work at a pace of the caller's: from one
/// thread in any order, or from one thread each.
class Runtime {
 public:
  /// `feed` may be null: nothing is recorded.
  Runtime(const RunPlan& plan, std::unique_ptr<HapticDevice> device,
          std::unique_ptr<RecordFeed> feed = nullptr);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  void start();
  /// Ends the loops (within a tick) with the force at zero and closes the recording. Safe to call
  /// twice. The error says why a recording is not whole.
  Result<void> stop();
  /// After `stop`: the device, still open, for the next run (a new opening may ask for calibration
  /// again). This runtime is over then.
  std::unique_ptr<HapticDevice> take_device();
  void step_haptic_once() { haptic_.step(); }
  void step_physics_once() { physics_.step(); }
  void drain_records_once() {
    if (feed_) feed_->drain();
  }

  /// Takes effect at the next edge of the loop that it concerns; false when the queue is full.
  bool send(const Command& command);
  void set_force_enabled(bool enabled);
  void calibrate_device() { exchange_.to_gate.push(GateWish::kCalibrate); }
  /// From the window's thread, at each picture: a dead-man that is not repeated counts as let go.
  void set_hand_wishes(const HandWishes& wishes) { exchange_.hand_wishes.publish(wishes); }

  const RenderSnapshot& snapshot() { return exchange_.to_window.read(); }
  const DeviceStatus& device_status() { return exchange_.device_status.read(); }
  const LoopStats& haptic_stats() { return exchange_.haptic_stats.read(); }
  const LoopStats& physics_stats() { return exchange_.physics_stats.read(); }
  /// Next point of the plot; false when there is none yet.
  bool pop_telemetry(Telemetry& point) { return exchange_.telemetry.pop(point); }

  bool recording() const { return feed_ && feed_->early_end().empty(); }
  /// Why the recording ended early; empty while all is well.
  std::string recording_failure() const;
  const Session& session() const { return session_; }
  /// Refused real-time rights, in words. Known a moment after `start`.
  std::string realtime_warning() const;

 private:
  void run_haptic();
  void run_physics();
  void run_writer();

  Session session_;
  std::unique_ptr<HapticDevice> device_;
  std::unique_ptr<RecordFeed> feed_;
  double haptic_period_s_, physics_period_s_;
  LoopExchange exchange_;
  HapticStage haptic_;
  PhysicsStage physics_;
  std::atomic<bool> running_{false};
  std::atomic<int> grant_{-1};  ///< bits of kPriority and kMemory; -1 until the loop has asked
  std::thread haptic_thread_, physics_thread_, writer_thread_;
  bool closed_ = false;
};

}  // namespace osteon
