#include "osteon/results/cohort.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace osteon {
namespace {

using CohortJson = nlohmann::ordered_json;
using AttemptsOf = std::map<std::string, std::vector<const AttemptRow*>>;  // by learner

CohortJson number_or_null(const std::optional<double>& value) {
  return value ? CohortJson(*value) : CohortJson(nullptr);
}

CohortLearner learner_of_attempts(const std::string& id,
                                  const std::vector<const AttemptRow*>& attempts,
                                  const LcCusumOptions& options) {
  CohortLearner learner;
  learner.learner = id;
  learner.attempts = attempts.size();
  std::vector<bool> alone;
  std::vector<int> place;  // of those that count for the curve, among all
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const AttemptRow* const row = attempts[i];
    const bool passed = row->verdict == "passed";
    learner.passed += passed ? 1 : 0;
    if (!was_guided(*row)) {
      alone.push_back(passed);
      place.push_back(static_cast<int>(i));
    }
    if (!row->score) continue;
    if (!learner.first_score) learner.first_score = row->score;
    learner.last = row->score;
    learner.last_lo = row->score_lo;
    learner.last_hi = row->score_hi;
  }
  const LcCusum curve = lc_cusum(alone, options);
  const auto in_all = [&](int at) { return at < 0 ? at : place[static_cast<std::size_t>(at)]; };
  learner.competent_at = in_all(curve.competent_at);
  learner.relapse_at = in_all(curve.relapse_at);
  return learner;
}

// Of sorted values, between the two next to it.
double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::vector<CohortStep> curve_of(const AttemptsOf& by_learner) {
  std::vector<std::vector<double>> scores;
  for (const auto& [id, attempts] : by_learner) {
    if (scores.size() < attempts.size()) scores.resize(attempts.size());
    for (std::size_t n = 0; n < attempts.size(); ++n)
      if (attempts[n]->score) scores[n].push_back(*attempts[n]->score);
  }
  std::vector<CohortStep> curve;
  for (std::vector<double>& step : scores) {
    std::sort(step.begin(), step.end());
    if (step.empty())
      curve.push_back({});
    else
      curve.push_back(
          {step.size(), quantile(step, 0.5), quantile(step, 0.25), quantile(step, 0.75)});
  }
  return curve;
}

// Names of an attempt's errors, each once, with its severity.
std::map<std::string, std::string> errors_in(const AttemptRow& row) {
  std::map<std::string, std::string> errors;
  const CohortJson report = CohortJson::parse(row.report_json, nullptr, false);
  if (!report.is_object() || !report.contains("errors") || !report["errors"].is_array())
    return errors;
  for (const CohortJson& error : report["errors"])
    if (error.is_object() && error.contains("name") && error["name"].is_string())
      errors.emplace(error["name"], error.value("severity", ""));
  return errors;
}

std::vector<CohortError> errors_of(const AttemptsOf& by_learner) {
  std::map<std::string, CohortError> counted;
  for (const auto& [id, attempts] : by_learner) {
    std::set<std::string> of_learner;
    for (const AttemptRow* row : attempts)
      for (const auto& [name, severity] : errors_in(*row)) {
        CohortError& error = counted[name];
        error.name = name;
        error.severity = severity;
        ++error.attempts;
        error.learners += of_learner.insert(name).second ? 1 : 0;
      }
  }
  std::vector<CohortError> errors;
  for (auto& [name, error] : counted) errors.push_back(std::move(error));
  std::stable_sort(errors.begin(), errors.end(), [](const CohortError& a, const CohortError& b) {
    return a.attempts > b.attempts;
  });
  return errors;
}

CohortJson metric_changes(const CohortJson& a, const CohortJson& b) {
  CohortJson list = CohortJson::array();
  if (!a.is_object() || !b.is_object()) return list;
  for (const auto& [name, value] : a.items()) {
    const auto other = b.find(name);
    if (other == b.end()) continue;
    const bool both = value.is_number() && other->is_number();
    list.push_back(
        {{"name", name},
         {"a", value},
         {"b", *other},
         {"change", both ? CohortJson(other->get<double>() - value.get<double>()) : CohortJson()}});
  }
  return list;
}

CohortJson stage_times(const CohortJson& a, const CohortJson& b) {
  CohortJson list = CohortJson::array();
  if (!a.is_array() || !b.is_array()) return list;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    list.push_back({{"name", a[i].value("name", "")},
                    {"a_s", a[i].value("completed_s", CohortJson())},
                    {"b_s", b[i].value("completed_s", CohortJson())}});
  return list;
}

CohortJson head_of(const AttemptRow& row) {
  return {{"id", row.id},
          {"learner", row.learner},
          {"scenario", row.scenario},
          {"verdict", row.verdict},
          {"score", number_or_null(row.score)},
          {"score_interval", {number_or_null(row.score_lo), number_or_null(row.score_hi)}},
          {"duration_s", row.duration_s},
          {"case", row.case_name}};
}

}  // namespace

Cohort cohort_of(const std::vector<AttemptRow>& rows, const LcCusumOptions& options) {
  std::map<std::string, AttemptsOf> by_scenario;
  for (const AttemptRow& row : rows) by_scenario[row.scenario][row.learner].push_back(&row);
  Cohort cohort;
  for (const auto& [name, by_learner] : by_scenario) {
    CohortScenario scenario;
    scenario.name = name;
    for (const auto& [id, attempts] : by_learner) {
      scenario.learners.push_back(learner_of_attempts(id, attempts, options));
      scenario.attempts += scenario.learners.back().attempts;
      scenario.passed += scenario.learners.back().passed;
    }
    scenario.errors = errors_of(by_learner);
    scenario.curve = curve_of(by_learner);
    cohort.push_back(std::move(scenario));
  }
  return cohort;
}

std::string to_json(const Cohort& cohort) {
  CohortJson all = CohortJson::array();
  for (const CohortScenario& scenario : cohort) {
    CohortJson learners = CohortJson::array(), errors = learners, curve = learners;
    for (const CohortLearner& one : scenario.learners)
      learners.push_back(
          {{"learner", one.learner},
           {"attempts", one.attempts},
           {"passed", one.passed},
           {"first_score", number_or_null(one.first_score)},
           {"last_score", number_or_null(one.last)},
           {"last_interval", {number_or_null(one.last_lo), number_or_null(one.last_hi)}},
           {"competent_at", one.competent_at},
           {"relapse_at", one.relapse_at}});
    for (const CohortError& one : scenario.errors)
      errors.push_back({{"name", one.name},
                        {"severity", one.severity},
                        {"attempts", one.attempts},
                        {"learners", one.learners}});
    for (const CohortStep& one : scenario.curve)
      curve.push_back({{"learners", one.learners},
                       {"median", one.median},
                       {"lower", one.lower},
                       {"upper", one.upper}});
    all.push_back({{"scenario", scenario.name},
                   {"attempts", scenario.attempts},
                   {"passed", scenario.passed},
                   {"learners", learners},
                   {"errors", errors},
                   {"curve", curve}});
  }
  return all.dump(2) + "\n";
}

Result<std::string> compare_attempts(const AttemptRow& a, const AttemptRow& b) {
  const CohortJson ra = CohortJson::parse(a.report_json, nullptr, false);
  const CohortJson rb = CohortJson::parse(b.report_json, nullptr, false);
  if (!ra.is_object() || !rb.is_object())
    return fail("its report cannot be read", ra.is_object() ? b.id : a.id);
  CohortJson both = CohortJson::array(), only_a = both, only_b = both;
  const auto in_a = errors_in(a), in_b = errors_in(b);
  for (const auto& [name, severity] : in_a) (in_b.count(name) ? both : only_a).push_back(name);
  for (const auto& [name, severity] : in_b)
    if (!in_a.count(name)) only_b.push_back(name);
  const bool same = a.scenario == b.scenario && a.scenario_version == b.scenario_version;
  const auto part = [](const CohortJson& report, const char* key) {
    return report.value(key, CohortJson());
  };
  const CohortJson json = {
      {"same_scenario", same},
      {"a", head_of(a)},
      {"b", head_of(b)},
      {"stages", same ? stage_times(part(ra, "stages"), part(rb, "stages")) : CohortJson::array()},
      {"errors", {{"both", both}, {"only_a", only_a}, {"only_b", only_b}}},
      {"metrics", metric_changes(part(ra, "metrics"), part(rb, "metrics"))}};
  return json.dump(2) + "\n";
}

}  // namespace osteon
