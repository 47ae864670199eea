#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "osteon/base/result.h"
#include "osteon/procedure/asked_findings.h"
#include "osteon/procedure/scenario.h"

namespace osteon {

/// How somebody works, in numbers. The defaults are the expert's.
struct Skill {
  std::string name = "expert";
  std::uint64_t seed = 1;           ///< of tremor, choices and detours
  double tremor_m = 0.00004;        ///< amplitude, 8 to 11 Hz
  double delay_s = 0.12;            ///< from a force to the answer to it
  double travel_m_per_s = 0.15;     ///< outside
  double approach_m_per_s = 0.012;  ///< close to a bone
  double press_n = 0.9;             ///< wanted force
  double press_spread_n = 0.1;      ///< standard deviation from bone to bone
  double dwell_s = 0.45;            ///< on the bone
  double think_s = 0.1;             ///< before each bone
  double detour_m = 0;              ///< how far ways lead astray
  double drift_m_per_s = 0;         ///< sideways while pressing
  double skip_share = 0;            ///< of the bones, left out
  double misgrade_share = 0;        ///< of the findings, stated otherwise than they are
  /// The one thing that is done wrong on purpose, on one bone; empty: nothing.
  std::string fault;
  std::string fault_hand;  ///< of a fault that belongs to one hand: its name in the scenario
};

Skill expert_skill();
/// A beginner: each number drawn from the range seen or assumed of novices, see docs/scoring.md.
Skill novice_skill(std::uint64_t seed);
/// The expert who makes one error of the scenario: by what the error's rule asks. Fails when the
/// scenario has no error of that name or nobody knows how to make it.
Result<Skill> bad_skill(const Scenario& scenario, const std::string& error_name);

/// What somebody of this skill says is wrong with the patient; a function of its arguments.
StatedFindings stated_by(const Skill& skill, const Scenario& scenario, const Case& the_case);

/// What `--surgeon` takes: "expert", "novice", "novice:SEED", "bad:NAME".
Result<Skill> parse_skill(const Scenario& scenario, std::string_view text);
/// All that it takes for a scenario.
std::vector<std::string> surgeons_of(const Scenario& scenario);

}  // namespace osteon
