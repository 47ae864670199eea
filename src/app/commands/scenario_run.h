#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/procedure/attempt.h"
#include "osteon/procedure/report.h"
#include "osteon/surgeon/skill.h"

namespace osteon {

/// The scenarios that Osteon ships, by name: assets/scenarios/*.toml, in alphabetical order.
Result<std::vector<Scenario>> shipped_scenarios();
/// A scenario by what a user names it: a shipped one's name, or a file.
Result<Scenario> open_scenario(const std::string& spec);
/// The standard that is shipped for a scenario; none: there is none.
Result<std::optional<Standard>> shipped_standard(const std::string& scenario);
/// The case that a scenario is checked and run on: `case_spec` if given, else the patient that
/// `seed` draws (with a side and a finding of those that the scenario names), else the built-in one
/// of its anatomy; felt as the scenario says unless the name says so itself.
std::string case_spec_of(const Scenario& scenario, const std::string& case_spec,
                         std::optional<std::uint64_t> seed);

/// One attempt by a virtual surgeon, without a window, as fast as it goes.
struct ScenarioRun {
  Scenario scenario;
  std::optional<Standard> standard;
  std::string case_spec;
  Skill skill;
  std::optional<std::filesystem::path> record_to;
};
struct ScenarioOutcome {
  Report report;
  Outcome outcome;
  std::vector<std::string> unreachable;  ///< bones that the surgeon found no way to
};
Result<ScenarioOutcome> run_scenario(const ScenarioRun& run);

}  // namespace osteon
