#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "commands/sessions/hand_in_loop.h"
#include "osteon/base/result.h"
#include "osteon/carve/carved_field.h"
#include "osteon/device/virtual_hand.h"
#include "osteon/procedure/report.h"
#include "osteon/scene/case.h"
#include "osteon/scene/path.h"
#include "osteon/session/session.h"
#include "runs/reports/carving_report.h"
#include "runs/reports/soft_report.h"
#include "runs/reports/torque_report.h"

namespace osteon {

class HandPlayer;

/// One hand of a run, with the path that it follows.
struct HeadlessHand {
  std::string name;  ///< "left"; unique
  ProbePath path;
  /// Makes whoever moves the tool instead of the path; empty: the path, or the run's `user`.
  std::function<std::unique_ptr<HandInLoop>(double tick_s)> user = {};
  /// Whose will that user follows; null: the path's. For who moves the hand otherwise.
  HandPlayer* player = nullptr;
};

/// What who plays a run may look at meanwhile.
struct RunSight {
  std::function<const BoneSnapshot*()> bones;  ///< as they are now; null before the first
  /// A copy of a bone as it is now; none: nothing was cut from it.
  std::function<std::optional<CarvedField>(std::uint32_t)> carved;
};

/// A run of a path on a case with the virtual hand: no window, no threads, no pacing.
struct HeadlessRun {
  std::shared_ptr<const Case> the_case;
  std::string case_source;  ///< as the user named it; kept in the recording
  ProbePath path;
  /// Several hands in one world; none: one hand on `path`.
  std::vector<HeadlessHand> hands;
  SessionSettings settings;
  HandParams hand;
  /// Plays the path on this device (driver's name), whose user must be an emulated one, with the
  /// safety gate between; empty: the hand without a device.
  std::string device;
  /// Makes whoever moves the tool instead of a path, for a tick of that length; empty: the path.
  std::function<std::unique_ptr<HandInLoop>(double tick_s)> user;
  /// Asked in each physics step for what somebody beside the hands says; goes with a command of
  /// the first hand where that one has none. May be empty.
  std::function<std::optional<Command>()> beside = {};
  std::function<bool()> done;  ///< of a run by users: asked after each tick whether it is over
  /// Whether what the run is for is over, whoever may still be at work. May be empty.
  std::function<bool()> over = {};
  bool ends_when_over = false;  ///< also where the hands' paths go on
  double longest_s = 0;         ///< of a run by users: it ends then at the latest
  std::optional<std::filesystem::path> record_to;
  /// Sees all hands' tools after every tick; may be empty.
  std::function<void(std::span<const ToolState* const>, const BoneSnapshot&)> on_hands;
  /// Is told before the first tick how to look at the run. May be empty.
  std::function<void(RunSight)> on_begin = {};
  /// Sees every tick; may be empty.
  std::function<void(const ToolState&, const BoneSnapshot&)> on_tick;
};

/// What the tray of such a run holds: all that the paths name.
std::vector<std::string> tray_of_hands(std::span<const HeadlessHand> hands);

/// What the session of a run is made of.
struct RunParts {
  SessionSettings settings;
  Tray tray;
  std::vector<Portal> portals;
  std::shared_ptr<const CarvingSetup> carving;  ///< null: no bone is removed
  std::shared_ptr<const SoftSetup> softs;       ///< null: nothing is soft
};
/// For these hands; `settings` say what the devices bear.
Result<RunParts> parts_of_run(const HeadlessRun& run, std::span<const HeadlessHand> hands,
                              SessionSettings settings);
/// The header of a recording of it.
RecordingHeader header_of_run(const HeadlessRun& run, const SessionSettings& settings,
                              const Tray& tray);

/// Reports of all hands, in their order.
struct HeadlessOutcome {
  std::vector<std::string> names;
  std::vector<Report> reports;
  std::optional<CarvingReport> carving;  ///< none: no bone could be carved
  std::vector<TorqueReport> torques;     ///< of each hand; none: no instrument had a shaft
  std::optional<SoftReport> softs;       ///< none: nothing was soft
};

/// Runs it to the end of the longest path, with the settings kept within what the device bears.
/// What a path says of instruments, power and jaws are commands of its hand. Tick times are
/// measured around the session's tick alone. Fails when the device cannot be opened or its force is
/// cut, when an instrument is not known, or when the recording cannot be written; what was recorded
/// until then stays.
Result<HeadlessOutcome> simulate_hands(const HeadlessRun& run);
/// The first hand's report.
Result<Report> simulate(const HeadlessRun& run);

}  // namespace osteon
