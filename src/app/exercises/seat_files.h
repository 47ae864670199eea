#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "exercises/scenario_files.h"
#include "osteon/base/result.h"

namespace osteon {

/// Where an instructor's own files for this seat are, in the user's data folder: exercises
/// (`scenarios/*.toml`), standards (`standards/NAME.toml`), and which exercises are set
/// (`course.toml`, or the file that OSTEON_COURSE names).
std::filesystem::path own_scenarios_folder();
std::filesystem::path own_standard_file(const std::string& scenario);
std::filesystem::path course_file();

/// Exercises as somebody is to see them.
struct ExerciseList {
  std::string title;                                ///< of the course; empty: none is set
  std::vector<Scenario> scenarios;                  ///< in their order
  std::vector<std::optional<std::uint64_t>> seeds;  ///< as scenarios: the patient that is set
  std::vector<Error> faults;                        ///< own files that cannot be used
};

/// The exercises that Osteon ships, then the seat's own. An own file that cannot be read, or has
/// the name of another exercise, is left out and told in `faults`. Fails where what is shipped
/// cannot be read.
Result<ExerciseList> all_exercises();
/// Those that the course sets; all where there is no course. A course that cannot be read sets
/// nothing; an exercise in it that does not exist is left out; both are told in `faults`.
Result<ExerciseList> set_exercises();

/// The standard that attempts at an exercise are judged by on this seat: the seat's own, else the
/// shipped one; none: there is none. Fails on an own one that cannot be read or is of another
/// exercise: nobody is to be judged by another standard than the one that was set.
Result<std::optional<Standard>> standard_in_use(const std::string& scenario);

}  // namespace osteon
