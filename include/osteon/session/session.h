#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "osteon/base/result.h"
#include "osteon/haptic/haptic.h"
#include "osteon/physics/bone_world.h"
#include "osteon/procedure/report.h"
#include "osteon/record/recording.h"
#include "osteon/scene/case.h"
#include "osteon/scene/command.h"
#include "osteon/scene/tool.h"

namespace osteon {

struct SessionSettings {
  std::uint64_t seed = 0;
  HapticParams haptic;
  PhysicsParams physics;  ///< its step is a whole number of haptic ticks
  double probe_radius_m = 0.00075;
};
/// Says which setting is out of its range, or that a physics step is not a whole number of ticks.
Result<void> check_settings(const SessionSettings& settings);
/// JSON with every setting, SI units; numbers come back to the bit.
std::string to_json(const SessionSettings& settings);
/// Fails on an unknown or missing setting, and on what check_settings refuses.
Result<SessionSettings> parse_settings(const std::string& json);

/// One run of one case: a function of (case, settings, input stream). Owns no thread and no clock.
///
/// One thread: call `tick`, which runs the physics steps that are due. Two threads: one calls
/// `haptic_tick`, the other `physics_step`, and they exchange ToolState and BoneSnapshot by
/// LatestValue; what each consumed is in the records, so that `replay` can repeat the run in one
/// thread, bit by bit. The haptic half (haptic_tick, last_tick_record) and the physics half
/// (physics_step, last_step_record, bones) share nothing that changes; everything else is for when
/// both rest.
///
/// Bones are carried forward by their velocities from the tick that first saw a snapshot: at that
/// tick by one tick's time, then by one more each tick until the next snapshot, at most 20 ms. With
/// both clocks in step this is the time since the snapshot; it follows from the records alone, and
/// does not grow when one clock runs slow against the other.
class Session {
 public:
  /// `settings` must satisfy check_settings.
  Session(std::shared_ptr<const Case> the_case, const SessionSettings& settings);
  ~Session();
  Session(Session&&) noexcept;

  /// A command acts at the begin of this tick; one for the physics at the next step. A command
  /// whose value is out of range is recorded and does nothing.
  const ToolState& tick(const ToolInput& input, const Command& command = {});

  /// Allocates, locks and logs nothing. kHoldBones is for physics_step and does nothing here.
  const ToolState& haptic_tick(const ToolInput& input, const BoneSnapshot& bones,
                               const Command& command = {});
  /// `tool` is a state that haptic_tick has given, or ToolState{} before the first. Only kHoldBones
  /// acts here.
  const BoneSnapshot& physics_step(const ToolState& tool, const Command& command = {});

  /// Record of the last haptic tick or physics step.
  const TickRecord& last_tick_record() const;
  const StepRecord& last_step_record() const;
  /// Physics steps that the last `tick` ran (0 or 1).
  int last_steps() const;

  const Case& the_case() const;
  const Tool& tool() const;
  const BoneSnapshot& bones() const;
  /// Over both halves. (A tick record's hash is over the haptic half and the bones that the tick
  /// consumed: what is known at that tick whatever the other thread does.)
  std::uint64_t state_hash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Header of a recording of a session with these settings.
RecordingHeader recording_header(const Case& the_case, const SessionSettings& settings,
                                 const std::string& case_source, const std::string& osteon_version);

struct ReplayOutcome {
  bool identical = true;
  std::uint64_t first_different_tick = 0;  ///< meaningful when not identical
  std::uint64_t ticks = 0;
  Report report;  ///< of what was replayed; its tick times are measured now
};

/// Repeats a recording in one thread. Compares every tick's force, proxy position and status, and
/// every state hash, bit by bit; goes on to the end after a difference. `on_tick` (may be empty)
/// sees each tick's tool state and the bones that it consumed. Fails when the case is not the
/// recording's, when its settings cannot be read, or when check_consumption refuses it.
Result<ReplayOutcome> replay(
    const Recording& recording, std::shared_ptr<const Case> the_case,
    const std::function<void(const ToolState&, const BoneSnapshot&)>& on_tick = {});

}  // namespace osteon
