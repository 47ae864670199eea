#include "osteon/procedure/attempt.h"

#include <algorithm>
#include <cmath>

#include "osteon/procedure/path_metrics.h"
#include "path_units.h"

namespace osteon {
namespace {

bool is_grave(const Outcome::Error& error) { return error.severity != Severity::kMinor; }

double points_of(const ScenarioPlan& plan, const ScenarioState& state) {
  double points = 0;
  for (const MadeError& made : state.errors) points += plan.scenario.errors[made.error].points;
  return points;
}

void add_errors(const ScenarioPlan& plan, const Case& the_case, const ScenarioState& state,
                Outcome& outcome) {
  for (const MadeError& made : state.errors) {
    const ScenarioError& error = plan.scenario.errors[made.error];
    const bool named = made.bone < the_case.bones.size();
    outcome.errors.push_back({error.name, error.severity, made.at_s, made.hand,
                              named ? the_case.bones[made.bone].name : std::string()});
  }
  std::stable_sort(outcome.errors.begin(), outcome.errors.end(),
                   [](const auto& a, const auto& b) { return a.at_s < b.at_s; });
}

Verdict judged(const Outcome& outcome, const Standard* standard) {
  const bool whole = std::all_of(outcome.stages.begin(), outcome.stages.end(),
                                 [](const Outcome::Stage& s) { return s.completed_s.has_value(); });
  if (!whole || std::any_of(outcome.errors.begin(), outcome.errors.end(), is_grave))
    return Verdict::kNotPassed;
  return standard ? verdict_of(*standard, *outcome.score) : Verdict::kUndecided;
}

}  // namespace

std::vector<std::string> attempt_metric_names() {
  return {"elapsed_s",          "path_mm",      "speed_mm_s",
          "smoothness",         "sparc",        "ldlj",
          "depth_mm",           "rotation_deg", "translational_actions",
          "rotational_actions", "peak_force_n", "impulse_n_s",
          "contact_time_s"};
}

AttemptMeter::AttemptMeter(double tick_s)
    : tick_s_(tick_s),
      stride_(std::max<std::uint64_t>(
          1, static_cast<std::uint64_t>(std::lround(1 / (kPathRateHz * tick_s))))) {}

void AttemptMeter::add(const ToolState& tool) {
  if (ticks_++ % stride_ == 0 && is_finite(tool.X_WP))
    path_.samples.push_back({static_cast<double>(ticks_) * tick_s_, tool.X_WP, false});
  const double force_n = is_finite(tool.force_W) ? tool.force_W.norm() : 0;
  peak_n_ = std::max(peak_n_, force_n);
  impulse_n_s_ += force_n * tick_s_;
  if (tool.contact_count > 0) contact_s_ += tick_s_;
}

Result<Metrics> AttemptMeter::finish() const {
  const auto way = path_metrics(path_);
  if (!way) return tl::unexpected(way.error());
  return Metrics{{"elapsed_s", static_cast<double>(ticks_) * tick_s_},
                 {"path_mm", way->path_mm},
                 {"speed_mm_s", way->speed_mm_s},
                 {"smoothness", way->smoothness.value_or(0)},
                 {"sparc", way->sparc.value_or(0)},
                 {"ldlj", way->ldlj.value_or(0)},
                 {"depth_mm", way->depth_mm},
                 {"rotation_deg", way->rotation_deg},
                 {"translational_actions", way->translational_actions},
                 {"rotational_actions", way->rotational_actions},
                 {"peak_force_n", peak_n_},
                 {"impulse_n_s", impulse_n_s_},
                 {"contact_time_s", contact_s_}};
}

Result<Outcome> outcome_of(const ScenarioPlan& plan, const Case& the_case,
                           const ScenarioState& state, Metrics metrics, const Standard* standard,
                           const StatedFindings& stated) {
  Outcome outcome;
  outcome.findings = grade_findings(plan.scenario.asks, the_case, stated);
  outcome.scenario = plan.scenario.name;
  outcome.scenario_version = plan.scenario.version;
  outcome.metrics = std::move(metrics);
  if (!outcome.findings.empty())
    outcome.metrics[kFindingsRight] = share_right_percent(outcome.findings);
  for (std::size_t i = 0; i < plan.scenario.stages.size(); ++i) {
    const double at_s = state.completed_s[i];
    outcome.stages.push_back(
        {plan.scenario.stages[i].name, at_s < 0 ? std::nullopt : std::optional<double>(at_s)});
  }
  add_errors(plan, the_case, state, outcome);
  if (standard) {
    auto score = score_of(*standard, outcome.metrics, points_of(plan, state));
    if (!score) return tl::unexpected(score.error());
    outcome.score = *score;
    outcome.standard_version = standard->version;
  }
  outcome.verdict = judged(outcome, standard);
  return outcome;
}

}  // namespace osteon
