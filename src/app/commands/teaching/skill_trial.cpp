#include "commands/teaching/skill_trial.h"

#include <algorithm>

#include "commands/teaching/scenario_run.h"

namespace osteon {
namespace {

struct SkillGroup {
  std::vector<Metrics> metrics;
  std::vector<bool> clean;  ///< all stages done, no grave error
};

bool is_clean(const Outcome& outcome) {
  return std::all_of(outcome.stages.begin(), outcome.stages.end(),
                     [](const Outcome::Stage& s) { return s.completed_s.has_value(); }) &&
         std::all_of(outcome.errors.begin(), outcome.errors.end(),
                     [](const Outcome::Error& e) { return e.severity == Severity::kMinor; });
}

Result<SkillGroup> play(const Scenario& scenario, int count, bool experts) {
  SkillGroup group;
  for (int n = 1; n <= count; ++n) {
    const auto seed = static_cast<std::uint64_t>(n);
    ScenarioRun run;
    run.scenario = scenario;
    run.case_spec = case_spec_of(scenario, "", seed);
    run.skill = experts ? expert_skill() : novice_skill(seed);
    run.skill.seed = seed;
    const auto done = run_scenario(run);
    if (!done) return tl::unexpected(done.error());
    group.metrics.push_back(done->outcome.metrics);
    group.clean.push_back(is_clean(done->outcome));
  }
  return group;
}

std::vector<StandardMetric> metrics_of(const Scenario& scenario) {
  std::vector<StandardMetric> wanted;
  for (const ScenarioMetric& m : scenario.metrics)
    wanted.push_back({m.name, 0, 1, m.weight, m.lower_is_better});
  return wanted;
}

}  // namespace

Result<SkillTrial> try_skill(const Scenario& scenario, int experts, int novices) {
  const auto able = play(scenario, experts, true);
  if (!able) return tl::unexpected(able.error());
  const auto fresh = play(scenario, novices, false);
  if (!fresh) return tl::unexpected(fresh.error());
  auto study = study_skill(able->metrics, fresh->metrics, metrics_of(scenario));
  if (!study) return tl::unexpected(study.error());
  SkillTrial trial{std::move(*study), 0, 0};
  for (std::size_t i = 0; i < able->clean.size(); ++i)
    trial.experts_not_passed += !(able->clean[i] && trial.study.passed[i]);
  for (std::size_t i = 0; i < fresh->clean.size(); ++i)
    trial.novices_passed += fresh->clean[i] && trial.study.passed[able->clean.size() + i];
  return trial;
}

}  // namespace osteon
