#pragma once

// A session is recorded and replayed, or goes on in another session from the bytes of its state.
#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <string>

#include "osteon/record/recording.h"
#include "osteon/session/session.h"

namespace osteon::testing {

/// The recording of a session of `run`, which has a case, settings and a tray, before its first
/// tick.
template <class Run>
Recording begin_recording(const Run& run) {
  Recording recording;
  recording.header = recording_header(*run.the_case, run.settings, "test", "0", run.tray);
  return recording;
}

/// Keeps the state of a session of one hand: a replay may begin here.
inline void keep_state(Recording& recording, const Session& session) {
  recording.states.push_back(stored_state(session));
}

/// Keeps the last tick of a session of one hand and, every `store_every` ticks (0: never), its
/// state.
inline void keep_tick(Recording& recording, const Session& session, std::uint64_t store_every = 0) {
  recording.ticks.push_back(session.last_tick_record());
  if (session.last_steps() > 0) recording.steps.push_back(session.last_step_record());
  if (store_every > 0 && session.tool_state().tick % store_every == 0)
    keep_state(recording, session);
}

/// Ends the recording of `session`; replayed from each of these times (s) it ends with the same
/// bits.
template <class Run>
void expect_same_replays(Recording& recording, const Run& run, const Session& session,
                         std::initializer_list<double> starts_s) {
  recording.complete = true;
  ReplayOptions options;
  options.tray = run.tray;
  options.softs = run.softs;
  for (const double from_s : starts_s) {
    options.from_s = from_s;
    const auto outcome = replay(recording, run.the_case, options);
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_TRUE(outcome->identical) << from_s << ": " << outcome->first_different_tick;
    EXPECT_EQ(outcome->state_hash, session.state_hash()) << from_s;
  }
}

/// `other` goes on where `session` stands, by way of the bytes of a state, which is returned.
inline SessionState go_on_as(Session& other, const Session& session) {
  const std::string bytes = to_bytes(session.save());
  const auto back = state_from_bytes(bytes);
  EXPECT_TRUE(back) << back.error().message();
  if (!back) return {};
  EXPECT_EQ(to_bytes(*back), bytes);
  EXPECT_TRUE(other.restore(*back));
  EXPECT_EQ(other.state_hash(), session.state_hash());
  return *back;
}

}  // namespace osteon::testing
