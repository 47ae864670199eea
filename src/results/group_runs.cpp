#include "osteon/results/group_runs.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace osteon {
namespace {

// The figures of an attempt in which every stage was done; none: it is no such attempt.
std::optional<Metrics> whole_attempt(const AttemptRow& row) {
  const auto report = nlohmann::json::parse(row.report_json, nullptr, false);
  if (!report.is_object() || !report.contains("stages") || !report.contains("metrics"))
    return std::nullopt;
  const auto &stages = report["stages"], &figures = report["metrics"];
  if (!stages.is_array() || stages.empty() || !figures.is_object()) return std::nullopt;
  for (const auto& stage : stages)
    if (!stage.is_object() || !stage.value("completed_s", nlohmann::json()).is_number())
      return std::nullopt;
  Metrics metrics;
  for (const auto& [name, value] : figures.items())
    if (value.is_number()) metrics[name] = value.get<double>();
  return metrics;
}

}  // namespace

GroupRuns runs_of_group(const std::vector<AttemptRow>& rows, const std::string& scenario,
                        int version, const std::vector<std::string>& learners,
                        CountedAttempt counted) {
  GroupRuns runs;
  for (const std::string& learner : learners) {
    if (std::count(runs.learners.begin(), runs.learners.end(), learner)) continue;
    std::optional<Metrics> found;
    bool tried = false, other_version = false;
    for (const AttemptRow& row : rows) {
      if (row.learner != learner || row.scenario != scenario) continue;
      tried = true;
      other_version |= row.scenario_version != version;
      if (row.scenario_version != version || was_guided(row)) continue;
      if (found && counted == CountedAttempt::kFirst) break;
      if (auto metrics = whole_attempt(row)) found = std::move(metrics);
    }
    if (!found) {
      runs.without.push_back(
          learner + (!tried          ? ": no attempt"
                     : other_version ? ": no whole attempt at version " + std::to_string(version)
                                     : ": no whole attempt"));
      continue;
    }
    runs.learners.push_back(learner);
    runs.metrics.push_back(std::move(*found));
  }
  return runs;
}

}  // namespace osteon
