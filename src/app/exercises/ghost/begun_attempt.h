#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "exercises/attempt_part.h"
#include "exercises/attempt_watch.h"
#include "exercises/ghost/ghost_recording.h"
#include "osteon/image/progress.h"
#include "runs/hands/begun_run.h"

namespace osteon {

/// An attempt at a part of an exercise whose begin the virtual expert has made.
struct BegunAttempt {
  BegunRun run;
  AttemptPart part;
  std::unique_ptr<AttemptWatch> watch;  ///< has judged the begin
};

struct BegunAttemptOrder {
  GhostWanted wanted;
  AttemptPart part;          ///< its tick is found
  const ScenarioPlan* plan;  ///< this and the hands must outlive the attempt
  std::span<const PlannedHand> hands;
  std::shared_ptr<const Case> the_case;
  std::optional<MadeGraft> graft;
  RunTray tray;
  std::function<std::optional<std::uint32_t>(const std::string&)> place;  ///< see BegunOrder
  std::filesystem::path file;          ///< what the attempt is recorded to
  std::filesystem::path program = {};  ///< that lets the expert work; empty: this one
};

/// Lets the virtual expert perform the exercise on this patient, where that is not known yet: up to
/// `wanted.to_stage`, or to the part's begin where that is empty. Repeats what he did until the
/// part's first stage begins, which takes a tenth of that time or more. Fails where he does not
/// come so far, and once `progress` says so; then no file is left.
Result<BegunAttempt> begin_attempt(const BegunAttemptOrder& order, const Progress& progress);

}  // namespace osteon
