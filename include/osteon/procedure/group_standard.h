#pragma once

#include <vector>

#include "osteon/base/result.h"
#include "osteon/procedure/skill_study.h"
#include "osteon/procedure/standard.h"

namespace osteon {

/// A standard that two groups of people have set, and how well it tells them apart.
struct GroupStandard {
  Standard standard;
  SkillStudy study;      ///< each person judged without that person
  ContrastingMark mark;  ///< of all scores: the standard's mark
};

/// Sets a standard by contrasting groups: mean and SD of each metric over the experts' runs; the
/// mark where both groups' scores part; reliability (Cronbach's alpha) and the scores' SD over all
/// persons. `draft` gives scenario, version, source, and the metrics with weight and direction. A
/// metric that is the same for all experts, but one at most, is left out (`study.left_out`). Where
/// one metric is left there is no reliability: it is 0 then, so that the interval is as wide as the
/// scores' spread allows. A run of each person, three persons in a group at least. Fails as
/// study_skill and contrasting_groups do.
Result<GroupStandard> standard_of_groups(Standard draft, const std::vector<Metrics>& experts,
                                         const std::vector<Metrics>& novices);

}  // namespace osteon
