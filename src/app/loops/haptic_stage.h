#pragma once

#include <array>
#include <cstdint>

#include "loops/assist.h"
#include "loops/fault_freeze.h"
#include "loops/hand_guide.h"
#include "loops/hand_mapping.h"
#include "loops/loop_exchange.h"
#include "osteon/device/haptic_device.h"
#include "osteon/device/safety.h"
#include "osteon/session/session.h"

namespace osteon {

class RecordFeed;
class StateKeeper;

/// How a stage is set up.
struct HapticStageOptions {
  DeviceMapping mapping;  ///< where the device is in World when the run begins
  MappingSettings user;   ///< sane
  SafetyParams safety;
  double tick_s = 0.001;
  ForceOff off_because = ForceOff::kSoftware;  ///< until the window wishes the force on
  /// A fault leaves the instrument where it is; false: a demonstration, which goes on moving.
  bool freezes = true;
  std::size_t hand = 0;  ///< of the session
  /// What the other hands publish, by hand; null: there is no such hand.
  std::array<LoopExchange*, kMaxHands> others{};
};

/// What the haptic loop does once a tick, without thread or clock: read the device, run the
/// session's tick on the newest bones, pass the force through the safety gate, record, publish.
/// Allocates, locks and logs nothing. Each device has a stage and a thread of its own; all meet one
/// session.
class HapticStage {
 public:
  /// All must outlive the stage; `feed` and `keeper` may be null (no recording). The force is off
  /// until the window wishes it on.
  HapticStage(Session& session, HapticDevice& device, const HapticStageOptions& options,
              LoopExchange& exchange, RecordFeed* feed, StateKeeper* keeper = nullptr);
  /// `dt_s`: time since the last step as the loop's clock measured it; the session's own time goes
  /// by ticks whatever it is.
  void step(double dt_s);
  void step() { step(options_.tick_s); }
  /// Zero force now, and no other after it: the run ends.
  void force_to_zero();

 private:
  void obey_gate_wishes();
  void obey_hand_wishes(DeviceSample& sample, double dt_s);
  ToolInput read_input(const DeviceSample& sample);
  bool has_fault() const;
  double bones_age(bool fresh, double dt_s);
  DeviceWrench wanted(const ToolState& tool) const;
  Vec3 guidance(const ToolState& tool, double dt_s);
  void give(const DeviceWrench& wrench);
  OtherTools read_others();
  Command next_command();
  void ramp_after_fade(const ToolState& tool);
  void note_fault();
  void publish(const ToolState& tool, const BoneSnapshot& bones);

  Session& session_;
  HapticDevice& device_;
  HapticStageOptions options_;
  LoopExchange& exchange_;
  RecordFeed* feed_;
  StateKeeper* keeper_;
  HandMapping mapping_;
  Assist assist_;
  HandGuide guide_;
  SafetyGate gate_;
  FaultFreeze freeze_;
  ToolInput last_good_;
  DeviceStatus status_;
  Telemetry telemetry_;
  HandWishes wishes_;
  double wishes_age_s_ = 0;
  double bones_age_s_ = 0;
  ForceOff told_ = ForceOff::kNone;  ///< the last cause that was seen
  bool fault_to_tell_ = false;
  bool fading_ = false;
  bool touching_ = false;
  bool over_ = false;
};

}  // namespace osteon
