#include "osteon/procedure/group_standard.h"

#include <algorithm>
#include <cmath>

#include "spread.h"

namespace osteon {

Result<GroupStandard> standard_of_groups(Standard draft, const std::vector<Metrics>& experts,
                                         const std::vector<Metrics>& novices) {
  auto study = study_skill(experts, novices, draft.metrics);
  if (!study) return tl::unexpected(study.error());
  const auto mark = contrasting_groups(study->expert_scores, study->novice_scores);
  if (!mark) return tl::unexpected(mark.error());
  std::erase_if(draft.metrics, [&](const StandardMetric& metric) {
    return std::find(study->left_out.begin(), study->left_out.end(), metric.name) !=
           study->left_out.end();
  });
  auto norm = norm_of(experts, std::move(draft.metrics));
  if (!norm) return tl::unexpected(norm.error());
  draft.metrics = std::move(*norm);
  std::vector<double> scores = study->expert_scores;
  scores.insert(scores.end(), study->novice_scores.begin(), study->novice_scores.end());
  draft.experts = static_cast<int>(experts.size());
  draft.score_sd = spread_of(scores).sd;
  draft.reliability =
      std::isfinite(study->reliability) ? std::clamp(study->reliability, 0.0, 1.0) : 0;
  draft.pass_score = mark->mark;
  return GroupStandard{std::move(draft), std::move(*study), *mark};
}

}  // namespace osteon
