#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/procedure/asked_findings.h"
#include "osteon/procedure/scenario.h"
#include "osteon/procedure/tool_events.h"
#include "osteon/scene/event.h"

namespace osteon {

/// A rule with its bones, or its landmarks, found in a case.
struct PlannedRule {
  Rule rule;
  std::vector<std::uint32_t> bones;  ///< or landmarks; none of a rule about the hand itself
  SubjectKind about = SubjectKind::kBone;
  std::uint8_t hand = kNoHand;         ///< kNoHand: any
  EventKind heeds = EventKind::kNone;  ///< see RuleKind
  std::vector<Vec3> places_W = {};     ///< of landmarks: where they are
  EventKind heeds_too = EventKind::kNone;
  bool applies = true;  ///< to this patient: else a goal is met, and an error cannot be made
};
/// A scenario on one case: what judging needs, and nothing that changes.
struct ScenarioPlan {
  Scenario scenario;
  std::vector<std::vector<PlannedRule>> goals;  ///< by stage
  std::vector<PlannedRule> errors;              ///< as scenario.errors
};
/// Index in Case::landmarks; none: there is none of that name.
std::optional<std::uint32_t> find_landmark(const Case& the_case, std::string_view name);
/// Fails on a bone or a landmark that the case does not have.
Result<ScenarioPlan> plan_scenario(const Scenario& scenario, const Case& the_case);
/// What the tool's events must be measured against so that the plan's rules can be judged.
ToolEventLimits event_limits(const Scenario& scenario);

/// Something that must last, or must not.
struct RuleHold {
  double since_s = -1;  ///< -1: it does not hold
  double last_s = -1;   ///< when it was last heard of
  double least = 0, most = 0;
  bool armed = false, told = false;
  bool operator==(const RuleHold&) const = default;
};
/// How far a rule is.
struct RuleState {
  std::vector<char> done;  ///< by bone of the rule
  bool met = false;
  std::vector<RuleHold> holds = {};  ///< by bone; of a rule about the hand itself one
  bool operator==(const RuleState&) const = default;
};
struct MadeError {
  std::uint32_t error = 0;  ///< in scenario.errors
  double at_s = 0;          ///< when it began
  std::uint8_t hand = 0;
  std::uint32_t bone = kNoSubject;  ///< none: an error about the hand itself
  bool operator==(const MadeError&) const = default;
};
/// How far an attempt is: a value, a function of (plan, events).
struct ScenarioState {
  std::uint32_t stage = 0;             ///< the live one; count of the stages once all are done
  std::vector<RuleState> goals;        ///< of the live stage
  std::vector<RuleState> error_rules;  ///< as scenario.errors
  std::vector<double> completed_s;     ///< by stage; -1: not yet
  std::vector<MadeError> errors;
  bool over = false;  ///< all stages done, time over, or a critical error
  bool operator==(const ScenarioState&) const = default;
};

ScenarioState begin_scenario(const ScenarioPlan& plan);
/// Takes one event into account. Events come in the order of their ticks. `held`: by hand, what it
/// holds, as a tray names it; of a hand that is not listed nothing is known, and rules that name
/// instruments do not apply to it.
void judge(const ScenarioPlan& plan, const Event& event, double tick_s, ScenarioState& state,
           std::span<const std::string_view> held = {});
/// The session went back to a restore point at which the attempt was `kept`: what was done since is
/// to be done again. Errors stay made, and so does what an error's rule waits for.
void go_back_to(const ScenarioState& kept, ScenarioState& state);
/// Ends the attempt at a time: what was left out becomes an error, and so does what was stated
/// wrongly of the patient.
void finish_scenario(const ScenarioPlan& plan, double at_s, ScenarioState& state,
                     const std::vector<GradedFinding>& graded = {});

}  // namespace osteon
