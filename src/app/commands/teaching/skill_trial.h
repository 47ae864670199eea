#pragma once

#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/procedure/scenario.h"
#include "osteon/procedure/skill_study.h"

namespace osteon {

/// Simulated experts and novices who each play a scenario on a patient of their own: the n-th of
/// both groups on the same one.
struct SkillTrial {
  SkillStudy study;
  int experts_not_passed = 0;  ///< by the score's mark, or a stage or a grave error
  int novices_passed = 0;      ///< by all three
};
Result<SkillTrial> try_skill(const Scenario& scenario, int experts, int novices);

}  // namespace osteon
