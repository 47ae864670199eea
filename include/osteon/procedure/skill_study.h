#pragma once

#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/procedure/standard.h"

namespace osteon {

/// How well a score tells two groups apart. Each person is judged by a norm and a mark that were
/// made without that person (leave one out): figures of the very people that set the standard would
/// flatter it.
struct SkillStudy {
  std::vector<double> expert_scores, novice_scores;  ///< each by the norm of the other experts
  double auc = 0;                                    ///< see area_under_curve
  double auc_se = 0;  ///< its standard error (Hanley and McNeil 1982)
  /// Cronbach's alpha over the metrics' z, all persons; NaN: fewer than two metrics.
  double reliability = 0;
  double mark = 0;         ///< mean of the contrasting-groups marks; NaN: the groups do not part
  int experts_failed = 0;  ///< below the mark that was set without them
  int novices_passed = 0;  ///< at or above it
  /// Persons without whom the others' scores set no mark, as where all of a group have the lowest
  /// score that there is: they count as failed, which says nothing of them.
  int without_mark = 0;
  /// Metrics that are the same in the runs of all experts, but one at most: they have no norm, and
  /// no score holds them.
  std::vector<std::string> left_out;
  std::vector<bool> passed;  ///< experts, then novices: at or above the mark set without them
};

/// Fails for fewer than three persons in a group, where all metrics are left out, and as norm_of
/// does.
Result<SkillStudy> study_skill(const std::vector<Metrics>& experts,
                               const std::vector<Metrics>& novices,
                               const std::vector<StandardMetric>& asked);

}  // namespace osteon
