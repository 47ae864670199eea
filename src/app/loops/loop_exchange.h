#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "loops/hand_guide.h"
#include "osteon/base/bounded_queue.h"
#include "osteon/base/latest_value.h"
#include "osteon/device/haptic_device.h"
#include "osteon/device/safety.h"
#include "osteon/scene/command.h"
#include "osteon/scene/event.h"
#include "osteon/scene/soft_pushes.h"
#include "osteon/scene/state.h"

namespace osteon {

/// How a loop keeps time, measured by itself.
struct LoopStats {
  std::uint64_t ticks = 0;
  std::uint64_t missed = 0;  ///< ticks skipped because the loop came late
  double rate_hz = 0;        ///< over the last quarter second; 0 before
  double p50_us = 0, p99_us = 0, p999_us = 0, max_us = 0;  ///< duration of one tick
};

/// What the haptic loop reports of the device.
struct DeviceStatus {
  ForceOff cause = ForceOff::kSoftware;
  Vec3 force_at_hand_V = Vec3::Zero();   ///< N, after the safety gate
  Vec3 torque_at_hand_V = Vec3::Zero();  ///< N m, likewise; zero where no rotation is driven
  std::uint64_t bad_samples = 0;         ///< readings refused: not finite, or not connected
  SafetyState safety;                    ///< what the gate sees and does, with the energy
  bool clutched = false;                 ///< the device moves without the tool
  bool dead_man_held = true;             ///< every switch and pedal that must be held is
  DeviceHealth health;                   ///< as the device told some ticks ago
  double guided_s = 0;                   ///< how long the hand was led along a way in this run
};

/// What the window tells the haptic loop of the user's feet and eyes; once a picture.
struct HandWishes {
  bool has_dead_man = false;  ///< a pedal or key must be held for force, besides the device's own
  bool dead_man_held = false;
  bool clutch = false;     ///< by a pedal or key, besides the device's own button
  bool turn_axes = false;  ///< tie the device's axes to `q_WV`, once nothing is touched
  Quat q_WV = Quat::Identity();
  GuideLine guide;  ///< where the hand shall be led
};

/// The user's wish for the safety gate and the device.
enum class GateWish : std::uint8_t { kEnable, kDisable, kCalibrate };

/// One point of the force plot and of the timeline: kTelemetryTicks ticks together.
struct Telemetry {
  double time_s = 0;
  float peak_force_n = 0;
  std::uint32_t status = 0;      ///< TickStatus bits of all the ticks
  std::uint64_t bones_mask = 0;  ///< bit i: bone i was touched
};
inline constexpr std::uint64_t kTelemetryTicks = 4;

/// All that one hand's loop passes to the others and they to it. Each member has one writer and one
/// reader, which the comment names. Commands for physics, its figures and what
/// presses soft parts go by the first hand's.
struct LoopExchange {
  explicit LoopExchange(const BoneSnapshot& bones)
      : bones_to_haptic(bones), to_window(RenderSnapshot{bones, {}}) {}

  LatestValue<ToolState> tool_to_physics;                       // haptic -> physics
  LatestValue<BoneSnapshot> bones_to_haptic;                    // physics -> haptic
  std::array<LatestValue<OtherTool>, kMaxHands> tool_to_hands;  // haptic -> haptic of that hand
  LatestValue<RenderSnapshot> to_window;                        // haptic -> window
  LatestValue<SoftPushes> pushes_to_window;                     // physics -> window
  LatestValue<DeviceStatus> device_status;                      // haptic -> window
  LatestValue<HandWishes> hand_wishes;                          // window -> haptic
  LatestValue<LoopStats> haptic_stats;                          // haptic -> window
  LatestValue<LoopStats> physics_stats;                         // physics -> window
  BoundedQueue<Telemetry> telemetry{4096};  // haptic -> window; 16 s, then points are dropped
  BoundedQueue<Event> events{1024};         // haptic -> window; full: the newest are dropped
  BoundedQueue<ToolState> judged{512};      // haptic -> window, each tick while `judging`
  std::atomic<bool> judging{false};         // window -> haptic
  BoundedQueue<Command> to_haptic{64};      // window -> haptic
  BoundedQueue<Command> to_physics{64};     // window -> physics
  BoundedQueue<GateWish> to_gate{16};       // window -> haptic
};

}  // namespace osteon
