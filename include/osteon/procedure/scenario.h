#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/scene/case.h"
#include "osteon/scene/event.h"

namespace osteon {

/// How much an error weighs: a minor one costs points, a major one cannot be passed with, a
/// critical one ends the attempt.
enum class Severity : std::uint8_t { kMinor, kMajor, kCritical };
std::string_view to_text(Severity severity);

/// What is asked of the stream of events, see rule_table(). Of a goal: until when; of an error:
/// what must not happen.
struct Rule {
  std::string kind;                       ///< a name of rule_table()
  std::vector<std::string> subjects;      ///< bones by name; empty: every bone of the case
  std::map<std::string, double> numbers;  ///< every number of the kind, those left out by default
  int line = 0;                           ///< in its file
  std::vector<std::string> marks = {};    ///< landmarks by name; of kinds about landmarks alone
  std::string hand = {};                  ///< of this hand alone; empty: of any
  /// "old_tunnel=sound": asked only of patients who have that finding, or only of others; empty:
  /// of all.
  std::string when = {}, unless = {};
  /// While the hand holds one of these, of whatever size; empty: whatever it holds.
  std::vector<std::string> instruments = {};
};

/// One hand of the exercise. A scenario that names none has one with the wrist probe.
struct ScenarioHand {
  std::string name;        ///< "scope"
  std::string instrument;  ///< as `osteon instruments` names it; one with optics is looked through
  std::string portal;      ///< landmark through which its shaft passes; empty: none
  int line = 0;
  std::vector<std::string> also = {};  ///< instruments that it may take beside that one
};

struct ScenarioStage {
  std::string name, title;
  std::string instruction;     ///< what to do, for the learner
  std::string cue;             ///< a hint on demand; may be empty
  std::string picture;         ///< file beside the scenario; may be empty
  bool restore_point = false;  ///< the learner may come back to its start
  std::string restore_title;   ///< what that restore point is called; empty: as the stage
  std::vector<Rule> goals;     ///< the stage is done once all are met
  int line = 0;
};

struct ScenarioError {
  std::string name, title;
  Severity severity = Severity::kMinor;
  std::string consequence;  ///< what it costs the patient, for the learner
  double points = 0;        ///< off the score, each time
  std::string source;       ///< mark of where the limit comes from
  Rule rule;
};

struct ScenarioMetric {
  std::string name;  ///< a key of the report's metrics
  std::string unit;
  double weight = 1;
  bool lower_is_better = true;
  double threshold = 0;  ///< the figure that learners are shown as their aim
  std::string source;
};

/// Something that may be wrong with the patient, of which the learner is asked to say how bad it
/// is.
struct AskedFinding {
  std::string name;                 ///< as the case's description names it: "geissler"
  std::string title;                ///< for the learner
  std::vector<std::string> grades;  ///< what may be stated beside "none"
  int line = 0;
};

/// An exercise, as data. docs/scenarios.md describes the file.
struct Scenario {
  std::string name, title, text;
  int version = 1;
  std::string anatomy;               ///< "wrist" or "knee": what grows its patients
  std::string felt;                  ///< "pieces", "hull" or "field": what of the bones is felt
  std::vector<std::string> soft;     ///< soft parts that give way, as `--soft` names them
  std::vector<std::string> fields;   ///< bones felt as fields all the same: they can be carved
  double cortex_mm = 1.2;            ///< of bones that are carved: how thick their hard shell is
  double irrigation_ml_per_min = 0;  ///< water over the bone that is cut
  double time_limit_s = 600;
  bool ghost = true;                  ///< an expert's instruments may be shown beside the learner's
  std::vector<std::string> sides;     ///< of the patients that are drawn; empty: as described
  std::vector<std::string> findings;  ///< "geissler=2": half of the drawn patients have one
  std::vector<std::string> always;    ///< the same, of every drawn patient: "traction=10kg"
  std::vector<std::string> one_of;    ///< drawn patients have them in turn: "old_socket=steep:..."
  std::vector<ScenarioHand> hands;
  std::vector<ScenarioStage> stages;
  std::vector<ScenarioError> errors;
  std::vector<ScenarioMetric> metrics;
  std::vector<AskedFinding> asks;
  std::string where;        ///< its file, for messages
  std::string source_text;  ///< what it was read from
};

/// A number that a rule takes.
struct RuleNumber {
  std::string_view name;  ///< with its unit
  double lo, hi, usual;
};
/// A kind of rule in words.
struct RuleKind {
  std::string_view name;
  std::string_view text;
  bool is_goal;  ///< of a stage; else of an error
  std::vector<RuleNumber> numbers;
  SubjectKind about = SubjectKind::kBone;  ///< bones, landmarks, or nothing (the hand itself)
  /// The one kind of event that it reads, whatever its subject; kNone: all about its subjects.
  EventKind heeds = EventKind::kNone;
  bool with_bone = false;  ///< of a kind about landmarks: names the bone that they lie on as well
  /// A second kind of event that it reads; kNone: none.
  EventKind heeds_too = EventKind::kNone;
};
const std::vector<RuleKind>& rule_table();
const RuleKind* find_rule_kind(std::string_view name);

/// Reads a scenario; strict as a case's file is: an unknown key, a missing one, a wrong type and a
/// number out of its range are errors with the line.
Result<Scenario> parse_scenario(std::string_view text, const std::string& where);
Result<Scenario> load_scenario(const std::filesystem::path& file);

/// What a careful author would want to know: names that repeat, a goal that can never be met
/// (a bone that the case lacks, a press that is itself an error, more time than there is), an error
/// that can never happen, a metric that no report has. Empty when sound. Each line begins with
/// file:line.
std::vector<std::string> check_scenario(const Scenario& scenario, const Case& the_case);

}  // namespace osteon
