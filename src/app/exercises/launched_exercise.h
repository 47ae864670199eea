#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "osteon/base/result.h"
#include "osteon/results/cmi5.h"

namespace osteon {

/// Statements of launches that wait until they can be sent.
std::filesystem::path launches_folder();

/// Does the exercise for this learner. The attempt that counts; none: there was no whole one.
using PlayLaunched = std::function<Result<std::optional<AttemptRow>>(const Cmi5Launch& launch,
                                                                     const std::string& learner)>;

/// What came of a launch.
struct LaunchedExercise {
  std::optional<AttemptRow> attempt;
  std::optional<Error> not_played;  ///< why the exercise could not be done
  Cmi5Sent sent;
  bool counts = true;
  std::string return_url;
};
/// Opens the session with the learning management system, plays, and tells it how the attempt
/// ended. A session that was opened is always ended, whatever comes between.
Result<LaunchedExercise> run_launched(const Cmi5Launch& launch, const Cmi5Way& way,
                                      const PlayLaunched& play);

}  // namespace osteon
