#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "osteon/base/percentiles.h"
#include "osteon/session/session.h"
#include "record_source.h"

namespace osteon {

/// Runs a recorded session's ticks and steps in one thread, each once all that it consumed is
/// there. Of tools and bones it keeps what a later tick or step may still consume.
class Replayer {
 public:
  /// `session` has done nothing yet. Both must outlive the replayer.
  Replayer(const RecordSource& source, Session& session);

  /// Begins after a stored state instead of at the start. False: what was on its way at that moment
  /// is not in the state, so that a replay cannot begin there.
  Result<bool> begin_at(const StoredState& at);

  enum class Outcome : std::uint8_t {
    kTick,   ///< one has run: `hand`, `record`, `bones` and `session` tell of it
    kEnd,    ///< every tick and step has run
    kStuck,  ///< what comes next consumed what is not there
    kError   ///< see `error`
  };
  Outcome next();

  std::size_t hand() const { return hand_; }
  const TickRecord& record() const { return record_; }  ///< as recorded
  const BoneSnapshot& bones() const { return *bones_; }
  const Session& session() const { return session_; }
  CutsFeed* cuts_feed() { return session_.cuts_feed(); }
  /// Of the newest step.
  double bones_time_s() const { return snapshots_.back().time_s; }
  /// Is told of each step after it has run. May be empty.
  void tell_steps(std::function<void()> on_step) { on_step_ = std::move(on_step); }
  /// Changes each tick's command before it runs. May be empty.
  void change_commands(std::function<void(Command&)> change) { change_ = std::move(change); }
  std::int64_t last_tick_ns() const { return last_tick_ns_; }
  /// Of the physics steps so far.
  const Percentiles& step_times() const { return step_times_; }
  std::int64_t elapsed_ns() const { return elapsed_ns_; }
  const Error& error() const { return *error_; }

 private:
  struct HandTrack {
    RecordStream<TickRecord> records;
    std::uint64_t done = 0;                       // ticks
    std::deque<ToolState> kept;                   // tools that may still be consumed
    OtherTools seen{};                            // on their way at a stored state
    std::array<std::uint64_t, kMaxHands> used{};  // newest of each other hand's ticks consumed
    std::uint64_t used_step = 0;
  };
  std::optional<std::size_t> runnable_hand();
  bool can_run(const HandTrack& track, const TickRecord& record);
  bool run_steps_to(std::uint64_t step);
  bool run_next_step();
  void run_tick(std::size_t hand);
  const ToolState* kept_tool(std::size_t hand, std::uint64_t tick) const;
  const BoneSnapshot* kept_bones(std::uint64_t step) const;
  std::optional<OtherTool> other_tool(const HandTrack& track, std::size_t hand,
                                      std::uint64_t tick) const;
  void forget();
  bool failed();

  const RecordSource& source_;
  Session& session_;
  std::vector<HandTrack> hands_;
  RecordStream<StepRecord> steps_;
  std::deque<BoneSnapshot> snapshots_;
  std::array<std::uint64_t, kMaxHands> used_by_steps_{};
  const ToolState before_first_{};

  std::size_t hand_ = 0;
  TickRecord record_;
  const BoneSnapshot* bones_ = nullptr;
  std::int64_t last_tick_ns_ = 0;
  Percentiles step_times_;
  std::int64_t elapsed_ns_ = 0;
  std::optional<Error> error_;
  std::function<void()> on_step_;
  std::function<void(Command&)> change_;
};

}  // namespace osteon
