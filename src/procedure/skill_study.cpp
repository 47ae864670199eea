#include "osteon/procedure/skill_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace osteon {
namespace {

template <class T>
std::vector<T> without(const std::vector<T>& all, std::size_t left_out) {
  std::vector<T> rest;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i != left_out) rest.push_back(all[i]);
  return rest;
}

Result<double> score_by(const std::vector<Metrics>& experts, const Metrics& person,
                        const std::vector<StandardMetric>& wanted) {
  auto norm = norm_of(experts, wanted);
  if (!norm) return tl::unexpected(norm.error());
  Standard standard;
  standard.metrics = std::move(*norm);
  const auto score = score_of(standard, person);
  if (!score) return tl::unexpected(score.error());
  return score->value;
}

// Whether leaving one person out may leave the same value in all runs.
bool may_be_all_alike(const std::vector<Metrics>& runs, const std::string& metric) {
  std::vector<double> values;
  for (const Metrics& run : runs)
    if (const auto found = run.find(metric); found != run.end()) values.push_back(found->second);
  if (values.size() != runs.size()) return false;  // norm_of says which run has none
  std::sort(values.begin(), values.end());
  const std::size_t last = values.size() - 1;
  return values[1] == values[last] || values[0] == values[last - 1];
}

double standard_error(double auc, std::size_t experts, std::size_t novices) {
  const double q1 = auc / (2 - auc), q2 = 2 * auc * auc / (1 + auc), a2 = auc * auc;
  const double n = static_cast<double>(experts), m = static_cast<double>(novices);
  const double variance = (auc * (1 - auc) + (n - 1) * (q1 - a2) + (m - 1) * (q2 - a2)) / (n * m);
  return std::sqrt(std::max(0.0, variance));
}

// z of every metric, turned so that more is better, a row a person.
Result<std::vector<std::vector<double>>> items_of(const std::vector<Metrics>& experts,
                                                  const std::vector<Metrics>& novices,
                                                  const std::vector<StandardMetric>& wanted) {
  const auto norm = norm_of(experts, wanted);
  if (!norm) return tl::unexpected(norm.error());
  std::vector<std::vector<double>> rows;
  for (const auto* group : {&experts, &novices})
    for (const Metrics& person : *group) {
      rows.emplace_back();
      for (const StandardMetric& m : *norm) {
        const auto value = person.find(m.name);
        if (value == person.end()) return fail("a run has no metric '" + m.name + "'", "study");
        rows.back().push_back((m.lower_is_better ? -1 : 1) * (value->second - m.mean) / m.sd);
      }
    }
  return rows;
}

// The marks set without each person, and what they decide.
void decide(SkillStudy& study) {
  double sum = 0;
  int marks = 0;
  const auto judge_one = [&](double score, const std::vector<double>& experts,
                             const std::vector<double>& novices) {
    const auto mark = contrasting_groups(experts, novices);
    if (mark) sum += mark->mark;
    marks += mark ? 1 : 0;
    study.without_mark += mark ? 0 : 1;
    // Groups that do not part set no mark: nobody passes.
    study.passed.push_back(mark && score >= mark->mark);
    return study.passed.back();
  };
  for (std::size_t i = 0; i < study.expert_scores.size(); ++i)
    study.experts_failed +=
        !judge_one(study.expert_scores[i], without(study.expert_scores, i), study.novice_scores);
  for (std::size_t i = 0; i < study.novice_scores.size(); ++i)
    study.novices_passed +=
        judge_one(study.novice_scores[i], study.expert_scores, without(study.novice_scores, i));
  study.mark = marks > 0 ? sum / marks : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Result<SkillStudy> study_skill(const std::vector<Metrics>& experts,
                               const std::vector<Metrics>& novices,
                               const std::vector<StandardMetric>& asked) {
  if (experts.size() < 3 || novices.size() < 3)
    return fail("a study needs three persons in each group", "study");
  SkillStudy study;
  std::vector<StandardMetric> wanted;
  for (const StandardMetric& metric : asked)
    if (may_be_all_alike(experts, metric.name))
      study.left_out.push_back(metric.name);
    else
      wanted.push_back(metric);
  if (wanted.empty())
    return fail("all metrics are the same in all runs of experts", "study",
                "Give metrics in which experts differ");
  for (std::size_t i = 0; i < experts.size(); ++i) {
    const auto score = score_by(without(experts, i), experts[i], wanted);
    if (!score) return tl::unexpected(score.error());
    study.expert_scores.push_back(*score);
  }
  for (const Metrics& novice : novices) {
    const auto score = score_by(experts, novice, wanted);
    if (!score) return tl::unexpected(score.error());
    study.novice_scores.push_back(*score);
  }
  study.auc = *area_under_curve(study.expert_scores, study.novice_scores);
  study.auc_se = standard_error(study.auc, experts.size(), novices.size());
  study.reliability = std::numeric_limits<double>::quiet_NaN();
  if (wanted.size() < 2) {
    decide(study);
    return study;
  }
  const auto items = items_of(experts, novices, wanted);
  if (!items) return tl::unexpected(items.error());
  const auto alpha = cronbach_alpha(*items);
  if (!alpha) return tl::unexpected(alpha.error());
  study.reliability = *alpha;
  decide(study);
  return study;
}

}  // namespace osteon
