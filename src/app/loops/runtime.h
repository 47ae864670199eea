#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "loops/device_mapping.h"
#include "loops/haptic_stage.h"
#include "loops/loop_exchange.h"
#include "loops/physics_stage.h"
#include "loops/realtime.h"
#include "loops/record_feed.h"
#include "loops/state_keeper.h"
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
  std::shared_ptr<const CarvingSetup> carving = nullptr;  ///< null: no bone is removed
  std::shared_ptr<const SoftSetup> softs;  ///< of the settings' soft parts; null: nothing is soft
};

/// One hand of a run: its device, and how that lies in World.
struct HandPlan {
  std::unique_ptr<HapticDevice> device;
  DeviceMapping mapping;
  MappingSettings mapping_settings;
  bool force_enabled = true;
  ForceOff off_because = ForceOff::kSoftware;
  bool freezes = true;  ///< by a fault; see HapticStageOptions
};

/// One run of a session with its loops: a haptic one for each hand (1 kHz) and physics (500 Hz),
/// each on a thread of its own, and another that writes the recording. The window's thread talks to
/// it through the methods below; none of them waits for a loop but `stop`. Where a method has a
/// hand and the caller names none, it is the first.
///
/// Without `start`, the `..._once` methods do the same work at a pace of the caller's: from one
/// thread in any order, or from one thread each.
class Runtime {
 public:
  /// `feed` may be null: nothing is recorded.
  Runtime(const RunPlan& plan, std::unique_ptr<HapticDevice> device,
          std::unique_ptr<RecordFeed> feed = nullptr);
  /// Several hands in one world: as many as the plan's settings name. What the plan itself says of
  /// a device is not read.
  Runtime(const RunPlan& plan, std::vector<HandPlan> hands,
          std::unique_ptr<RecordFeed> feed = nullptr, Tray tray = {});
  /// Goes on from where a session is, which was made of the plan's case and settings and has done
  /// ticks of all hands already.
  Runtime(const RunPlan& plan, std::vector<HandPlan> hands, std::unique_ptr<RecordFeed> feed,
          Session begun);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  void start();
  /// Ends the loops (within a tick) with the force at zero and closes the recording. Safe to call
  /// twice. The error says why a recording is not whole.
  Result<void> stop();
  /// After `stop`: the device, still open, for the next run (a new opening may ask for calibration
  /// again). This runtime is over then.
  std::unique_ptr<HapticDevice> take_device(std::size_t hand = 0);
  void step_haptic_once(std::size_t hand = 0) { hands_[hand]->stage.step(); }
  void step_physics_once() { physics_.step(); }
  void drain_records_once();

  std::size_t hands() const { return hands_.size(); }
  /// Takes effect at the next edge of the loop that it concerns; false when a queue is full.
  /// kMark and kRestore go to every hand and to physics.
  bool send(const Command& command, std::size_t hand = 0);
  void set_force_enabled(bool enabled);
  void set_force_enabled(bool enabled, std::size_t hand);
  void calibrate_device(std::size_t hand = 0) { exchange(hand).to_gate.push(GateWish::kCalibrate); }
  /// From the window's thread, at each picture: a dead-man that is not repeated counts as let go.
  void set_hand_wishes(const HandWishes& wishes, std::size_t hand = 0) {
    exchange(hand).hand_wishes.publish(wishes);
  }

  const RenderSnapshot& snapshot(std::size_t hand = 0) { return exchange(hand).to_window.read(); }
  const DeviceStatus& device_status(std::size_t hand = 0) {
    return exchange(hand).device_status.read();
  }
  /// What presses soft solids now; nothing where none is soft.
  const SoftPushes& pushes() { return exchange(0).pushes_to_window.read(); }
  const LoopStats& haptic_stats(std::size_t hand = 0) { return exchange(hand).haptic_stats.read(); }
  const LoopStats& physics_stats() { return exchange(0).physics_stats.read(); }
  /// Next point of the plot; false when there is none yet.
  bool pop_telemetry(Telemetry& point, std::size_t hand = 0) {
    return exchange(hand).telemetry.pop(point);
  }

  /// How bones are carved, for one thread that draws; null: none is.
  CutsFeed* cuts_feed() { return session_.cuts_feed(); }
  /// Next thing that happened to a hand; false when there is none yet.
  bool pop_event(Event& event, std::size_t hand = 0) { return exchange(hand).events.pop(event); }

  /// Before `start`: every tick of every hand can be had from `pop_judged`. When nobody takes them
  /// for half a second, some are left out.
  void judge_ticks();
  bool pop_judged(ToolState& tool, std::size_t hand) { return exchange(hand).judged.pop(tool); }

  bool recording() const { return feed_ && feed_->early_end().empty(); }
  /// Why the recording ended early; empty while all is well.
  std::string recording_failure() const;
  const Session& session() const { return session_; }
  /// Refused real-time rights, in words. Known a moment after `start`.
  std::string realtime_warning() const;

 private:
  // A hand's device, what its loop exchanges, and what the loop does.
  struct Hand {
    Hand(Session& session, HandPlan&& plan, LoopExchange& own, const HapticStageOptions& options,
         RecordFeed* feed, StateKeeper* keeper);
    std::unique_ptr<HapticDevice> device;
    LoopExchange& exchange;
    HapticStage stage;
    std::atomic<int> grant{-1};  ///< bits of kPriority and kMemory; -1 until the loop has asked
    std::thread thread;
  };
  void tell_begun();
  void make_hands(const RunPlan& plan, std::vector<HandPlan>&& hands);
  LoopExchange& exchange(std::size_t hand) { return *exchanges_[hand]; }
  void run_haptic(Hand& hand);
  void run_physics();
  void run_writer();

  Session session_;
  std::unique_ptr<RecordFeed> feed_;
  std::unique_ptr<StateKeeper> keeper_;  ///< of a run that is recorded
  double haptic_period_s_, physics_period_s_;
  std::vector<std::unique_ptr<LoopExchange>> exchanges_;
  std::vector<std::unique_ptr<Hand>> hands_;
  PhysicsStage physics_;
  std::atomic<bool> running_{false};
  std::thread physics_thread_, writer_thread_;
  bool closed_ = false;
};

}  // namespace osteon
