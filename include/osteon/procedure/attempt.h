#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "osteon/procedure/asked_findings.h"
#include "osteon/procedure/judge.h"
#include "osteon/procedure/report.h"
#include "osteon/procedure/sight_events.h"
#include "osteon/procedure/standard.h"
#include "osteon/scene/path.h"

namespace osteon {

/// Names of the metrics that every attempt has; docs/scoring.md says what each is.
std::vector<std::string> attempt_metric_names();

/// Gathers an attempt's metrics from the tool's states, one a tick: the way of the proxy at 100 Hz
/// and the forces.
class AttemptMeter {
 public:
  explicit AttemptMeter(double tick_s = 0.001);
  void add(const ToolState& tool);
  /// A measure that the way does not define counts as 0.
  Result<Metrics> finish() const;

 private:
  double tick_s_;
  std::uint64_t stride_, ticks_ = 0;
  ProbePath path_;
  double peak_n_ = 0, impulse_n_s_ = 0, contact_s_ = 0;
};

/// What came of an attempt.
struct Outcome {
  struct Stage {
    std::string name;
    std::optional<double> completed_s;
  };
  struct Error {
    std::string name;
    Severity severity = Severity::kMinor;
    double at_s = 0;
    int hand = 0;
    std::string subject;
  };
  std::string scenario;
  int scenario_version = 1, standard_version = 0;  ///< 0: there was no standard
  Verdict verdict = Verdict::kUndecided;
  std::optional<Score> score;  ///< none without a standard
  std::vector<Stage> stages;
  std::vector<Error> errors;  ///< in the order in which they began
  Metrics metrics;
  std::vector<GradedFinding> findings = {};  ///< of a scenario that asks for them
  std::optional<ObscuredSight> sight = {};   ///< of who looked through a scope into water
};

/// Verdict: not passed when a stage was not completed or an error is major or critical; else what
/// the score says. Without a standard nothing can be passed: undecided at best. `stated`: what the
/// learner says is wrong with the patient, measured against the case where the scenario asks.
Result<Outcome> outcome_of(const ScenarioPlan& plan, const Case& the_case,
                           const ScenarioState& state, Metrics metrics, const Standard* standard,
                           const StatedFindings& stated = {});

/// The report of a run with an attempt's outcome before it: `scenario, verdict, score,
/// score_interval, stages, errors, metrics`, `findings` where the scenario asks, then the keys of
/// to_json(Report).
std::string to_json(const Report& report, const Outcome& outcome);
/// For a terminal.
std::string to_text(const Outcome& outcome);

}  // namespace osteon
