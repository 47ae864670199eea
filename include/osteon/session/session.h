#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/haptic/haptic.h"
#include "osteon/physics/bone_world.h"
#include "osteon/physics/carving_setup.h"
#include "osteon/procedure/report.h"
#include "osteon/record/recording.h"
#include "osteon/scene/case.h"
#include "osteon/scene/command.h"
#include "osteon/scene/event.h"
#include "osteon/scene/portal.h"
#include "osteon/scene/soft_pushes.h"
#include "osteon/scene/tool.h"
#include "osteon/session/cuts_feed.h"
#include "osteon/session/session_state.h"

namespace osteon {

class Carving;
class SoftWorld;
struct SoftSetup;

/// One hand of a session.
struct HandSettings {
  std::string name;              ///< "left", "right"; empty: the only one
  std::uint32_t instrument = 0;  ///< in the tray, at the start
};

/// The instruments that hands may take, all made before the session begins.
using Tray = std::vector<std::shared_ptr<const Tool>>;

struct SessionSettings {
  std::uint64_t seed = 0;
  HapticParams haptic;
  PhysicsParams physics;            ///< its step is a whole number of haptic ticks
  double probe_radius_m = 0.00075;  ///< of the wrist probe, which is held where the tray is empty
  double force_limit_n = 5;         ///< a force above it is an event
  std::vector<HandSettings> hands{1};
  CarveSettings carve;            ///< of bones that instruments remove
  std::vector<std::string> tray;  ///< names of the tray's instruments, for who makes them again
  /// Names or titles of the portals that are open; "all": every one of the case but those under a
  /// patch of skin (`soft`).
  std::vector<std::string> portals = {"all"};
  PortalSkin portal_skin;
  /// Soft parts that are felt, as make_soft_setup reads them; none: nothing soft is felt.
  std::vector<std::string> soft;
  /// The joint's water counts for the state's hash. Not in recordings that were made before it was
  /// part of the state: it flows in their replays all the same.
  bool water = true;
  /// What lies in the middle of a scope's picture is an event. Not in recordings that were made
  /// before there were such.
  bool sights = true;
  /// What the tip of an instrument goes into and comes out of is an event. Not in recordings that
  /// were made before there were such.
  bool structures = true;
  /// Those of the case's soft parts too. False for a case that was opened without them, and in
  /// recordings that were made before there were such: a replay that has them does not look.
  bool soft_structures = true;
  std::uint64_t soft_hash = 0;  ///< SoftSetup::hash of what was made of them; 0: not made yet
};
/// Says which setting is out of its range, or that a physics step is not a whole number of ticks.
Result<void> check_settings(const SessionSettings& settings);
/// JSON with every setting, SI units; numbers come back to the bit.
std::string to_json(const SessionSettings& settings);
/// Fails on an unknown or missing setting, and on what check_settings refuses.
Result<SessionSettings> parse_settings(const std::string& json);

/// The holes in the skin of a session, by ToolState::portal, in the case's order; after them those
/// that can be made in its patches of skin. Fails on a name that the case does not have.
Result<std::vector<Portal>> open_portals(const Case& the_case, const SessionSettings& settings);

/// What a hand does in one tick.
struct HandInput {
  ToolInput input;
  Command command;
};

/// One run of one case: a function of (case, settings, tray, input streams). Owns no thread and no
/// clock. Up to four hands meet the same bones, and each other.
///
/// One thread: call `tick`, which runs the physics steps that are due; every hand sees the others'
/// tools as the tick before left them. Several threads: one for each hand calls its `haptic_tick`,
/// another `physics_step`, and they exchange ToolState and BoneSnapshot by LatestValue; what each
/// consumed is in the records, so that `replay` can repeat the run in one thread, bit by bit. The
/// halves (one a hand: haptic_tick, last_tick_record, last_events, save_hand; physics:
/// physics_step, last_step_record, bones, save_world) share nothing that changes; everything else
/// is for when all rest.
///
/// A thread of a hand reads the other hands' tools before the bones. Then states that hands and
/// physics save by themselves belong together: physics sets BoneSnapshot::saved_step, and a hand
/// saves its state before the first tick that consumes a snapshot of that step or later.
///
/// Bones are carried forward by their velocities from the tick that first saw a snapshot: at that
/// tick by one tick's time, then by one more each tick until the next snapshot, at most 20 ms. With
/// both clocks in step this is the time since the snapshot; it follows from the records alone, and
/// does not grow when one clock runs slow against the other.
///
/// kMark keeps the state, kRestore goes back to it: bones, instruments, power. Hands stay where
/// their devices are, their forces fade to zero and rise again once they have been free. Ticks and
/// steps go on counting; the epoch, which counts the times, tells each half whether the other has
/// gone back too.
class Session {
 public:
  /// `settings` must satisfy check_settings and open_portals. An empty tray holds the wrist probe
  /// alone. `carving`: what make_carving made for the case, the tray and `settings.carve`; null: no
  /// bone is removed. `softs`: what make_soft_setup made of the case for `settings.soft`; null:
  /// nothing soft is felt.
  Session(std::shared_ptr<const Case> the_case, const SessionSettings& settings, Tray tray = {},
          std::shared_ptr<const CarvingSetup> carving = nullptr,
          std::shared_ptr<const SoftSetup> softs = nullptr);
  ~Session();
  Session(Session&&) noexcept;

  /// A command acts at the begin of this tick; one for the physics at the next step. A command
  /// whose value is out of range is recorded and does nothing. Returns the first hand's tool.
  const ToolState& tick(std::span<const HandInput> hands);
  const ToolState& tick(const ToolInput& input, const Command& command = {});

  /// Allocates, locks and logs nothing. kHoldBones is for physics_step and does nothing here.
  const ToolState& haptic_tick(std::size_t hand, const ToolInput& input, const BoneSnapshot& bones,
                               const OtherTools& others, const Command& command = {});
  const ToolState& haptic_tick(const ToolInput& input, const BoneSnapshot& bones,
                               const Command& command = {});
  /// `tools`: of each hand a state that its haptic_tick has given, or ToolState{} before the first.
  /// Only commands that is_for_physics act here. Allocates, locks and logs nothing.
  const BoneSnapshot& physics_step(std::span<const ToolState* const> tools,
                                   const Command& command = {});
  const BoneSnapshot& physics_step(const ToolState& tool, const Command& command = {});

  /// Record of the last haptic tick or physics step.
  const TickRecord& last_tick_record(std::size_t hand = 0) const;
  const StepRecord& last_step_record() const;
  /// What happened in a hand's last tick.
  std::span<const Event> last_events(std::size_t hand = 0) const;
  /// Physics steps that the last `tick` ran (0 or 1).
  int last_steps() const;

  const Case& the_case() const;
  std::size_t hands() const;
  /// What a hand holds.
  const Tool& tool(std::size_t hand = 0) const;
  const ToolState& tool_state(std::size_t hand = 0) const;
  const Tray& tray() const;
  /// By ToolState::portal.
  std::span<const Portal> portals() const;
  /// The carved bones, as physics has them; null: none is carved. For when all rest.
  const Carving* carving() const;
  /// Whether all that the steps so far have cut is on its way to that hand. From the thread of
  /// physics: until it is, the hand must be given no snapshot, or a replay would feel otherwise.
  bool told(std::size_t hand) const;
  /// Sends a hand what waits, whatever room there is. For one thread that runs all halves.
  void catch_up();
  /// For one thread that draws: how the bones are carved; null: none is.
  CutsFeed* cuts_feed();
  /// The soft parts, as physics has them; null: nothing is soft. For when all rest.
  const SoftWorld* softs() const;
  const BoneSnapshot& bones() const;
  /// Over all halves. (A tick record's hash is over the hand's half and the bones that the tick
  /// consumed: what is known at that tick whatever the other threads do.)
  std::uint64_t state_hash() const;

  SessionState save() const;
  /// A state of a session of the same case, settings and tray. Fails, and changes nothing, when it
  /// cannot be one.
  Result<void> restore(const SessionState& state);
  /// The parts of `save`, each for its own thread. Nothing is allocated where `into` has been
  /// filled by it before.
  void save_hand(std::size_t hand, HandState& into) const;
  void save_world(WorldState& into) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The state of a session whose halves rest after a step, as a recording keeps it.
StoredState stored_state(const Session& session);

/// Header of a recording of a session with these settings and this tray, which a replay must be
/// given again. Without a tray whose names the settings hold, its hash is not known.
RecordingHeader recording_header(const Case& the_case, const SessionSettings& settings,
                                 const std::string& case_source, const std::string& osteon_version,
                                 const Tray& tray = {});

struct ReplayOutcome {
  bool identical = true;
  std::size_t first_different_hand = 0;    ///< meaningful when not identical
  std::uint64_t first_different_tick = 0;  ///< of that hand
  std::uint64_t ticks = 0;                 ///< replayed, of the hand with the most
  std::uint64_t first_tick = 1;            ///< of the first hand; above 1: begun at a stored state
  /// False: the recording breaks off, or its end consumed what was not saved.
  bool complete = true;
  std::uint64_t state_hash = 0;  ///< over the whole final state
  Report report;                 ///< of the first hand; its tick times are measured now
  std::vector<Report> reports;   ///< of every hand
};

struct ReplayOptions {
  /// Sees each tick's tool state, the bones that it consumed, and what happened in it.
  std::function<void(std::size_t hand, const ToolState&, const BoneSnapshot&,
                     std::span<const Event>)>
      on_tick;
  /// Begins at the last stored state that is not after this time of the first hand; 0: at the
  /// start.
  double from_s = 0;
  Tray tray;                                    ///< as the recorded session had it
  std::shared_ptr<const CarvingSetup> carving;  ///< likewise
  std::shared_ptr<const SoftSetup> softs;       ///< likewise
  /// Sees how bones are carved, about 60 times a second of the recording; none: nobody looks.
  std::function<void(const CutsPatch&, double time_s)> on_cuts = {};
  /// Sees what presses soft solids, before each tick that on_tick sees; none: nobody looks.
  std::function<void(const SoftPushes&)> on_pushes = {};
  /// Sees how long each tick took, before on_tick.
  std::function<void(std::size_t hand, std::int64_t ns)> on_tick_time = {};
  double to_s = 0;  ///< ends before the first hand's tick after this time; 0: at the end
  /// The reports are about the ticks after this one.
  std::uint64_t reported_after = 0;
  std::function<void(const Session&)> at_begin;  ///< sees the session, which lasts to the end
  std::function<void(const Session&)> at_end;    ///< sees the session after its last tick
};

struct RepeatOptions {
  /// After each tick of a hand, with the bones that it consumed. False: nothing follows.
  std::function<bool(std::size_t hand, const BoneSnapshot&)> on_tick;
  std::function<void()> on_step;         ///< after each physics step; may be empty
  std::function<void(Command&)> change;  ///< of each tick's command, before it; may be empty
};
/// Lets a session that has done nothing yet do what a recording's did, until `on_tick` has enough
/// or the recording ends: a live run may go on from there. The session's settings and tray may
/// differ from the recording's; then what comes of it differs too. Fails when the case or the
/// number of hands is another one, or when the recording cannot be read.
Result<void> repeat(RecordingReader& recording, Session& session, const RepeatOptions& options);

/// Repeats a recording in one thread. Compares every tick's force, proxy position and status, and
/// every state hash, bit by bit; goes on to the end after a difference. Fails when the case, the
/// tray or the portals are not the recording's, when its settings cannot be read, or when what was
/// consumed is out of order.
Result<ReplayOutcome> replay(const Recording& recording, std::shared_ptr<const Case> the_case,
                             const ReplayOptions& options);
/// The same piece by piece: memory does not grow with the recording's length.
Result<ReplayOutcome> replay(RecordingReader& recording, std::shared_ptr<const Case> the_case,
                             const ReplayOptions& options);
/// The first hand's ticks alone are told.
Result<ReplayOutcome> replay(
    const Recording& recording, std::shared_ptr<const Case> the_case,
    const std::function<void(const ToolState&, const BoneSnapshot&)>& on_tick = {});

}  // namespace osteon
