#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/physics/carving_setup.h"
#include "osteon/procedure/scenario.h"
#include "osteon/procedure/standard.h"

namespace osteon {

/// The scenarios that Osteon ships, by name: assets/scenarios/*.toml, in alphabetical order.
Result<std::vector<Scenario>> shipped_scenarios();
/// A scenario by what a user names it: the name of a shipped one or of one of the user's own, or a
/// file.
Result<Scenario> open_scenario(const std::string& spec);
/// The standard that is shipped for a scenario; none: there is none.
Result<std::optional<Standard>> shipped_standard(const std::string& scenario);
/// The case that a scenario is checked and run on: `case_spec` if given, else the patient that
/// `seed` draws (with a side and a finding of those that the scenario names), else the built-in one
/// of its anatomy; felt as the scenario says unless the name says so itself.
std::string case_spec_of(const Scenario& scenario, const std::string& case_spec,
                         std::optional<std::uint64_t> seed);

/// How a scenario's bones are removed in a run.
CarveSettings carve_settings(const Scenario& scenario);

/// Writes into a recording what it must hold so that the attempt can be judged again.
Result<void> note_attempt(const std::filesystem::path& recording, const Scenario& scenario,
                          const std::optional<Standard>& standard, const std::string& by,
                          const std::string& report_json);

/// Keeps an attempt among the user's results, with where its recording is, if it has one. Where the
/// store cannot be written now it waits: the value says why.
Result<std::optional<Error>> keep_report(const std::string& report_json, const std::string& learner,
                                         const std::filesystem::path& recording = {});

}  // namespace osteon
