#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "exercises/ghost/ghost_track.h"
#include "osteon/base/result.h"
#include "osteon/procedure/scenario.h"

namespace osteon {

/// The attempt that somebody makes, beside whom a ghost shall be shown.
struct GhostWanted {
  Scenario scenario;
  std::string case_spec;
  std::uint64_t case_hash = 0;
  std::string graft_json = {};  ///< a report of making one, which is placed; empty: none
  std::string to_stage = {};    ///< no stage after this one matters; empty: all do
};

/// Is shown a way as far as it is known, each time that another step of the exercise has been
/// repeated, and before it is known whether its maker passes. May be empty.
using SeeGhost = std::function<void(GhostTrack)>;

/// The way through an exercise that a recording shows. Repeats and judges it. Fails where it is of
/// another exercise or another patient, where it does not repeat, and where nothing was done in it.
Result<GhostTrack> ghost_of_recording(const std::filesystem::path& recording,
                                      const GhostWanted& wanted, const SeeGhost& see = {});

/// Lets the virtual expert perform the exercise on the same patient, in a program of its own that
/// gives way to others (`osteon run`), and keeps the recording in the cache: the next time it is
/// only repeated. `go_on`: asked many times a second; false ends the program. `program`: the one to
/// start; empty: this one.
Result<GhostTrack> ghost_of_expert(const GhostWanted& wanted, const std::function<bool()>& go_on,
                                   const std::filesystem::path& program = {},
                                   const SeeGhost& see = {});
/// Where that recording is kept.
std::filesystem::path expert_recording(const GhostWanted& wanted);
/// The same, or that of the whole exercise, where it is kept.
std::filesystem::path kept_expert(const GhostWanted& wanted);
/// Makes that recording where it is not kept yet, as ghost_of_expert does.
Result<std::filesystem::path> recorded_expert(const GhostWanted& wanted,
                                              const std::function<bool()>& go_on,
                                              const std::filesystem::path& program = {});

/// ghost_strength() of a learner's attempts at an exercise, as they are stored. 1 where the store
/// cannot be read.
double ghost_strength_of(const std::string& learner, const std::string& scenario);

}  // namespace osteon
