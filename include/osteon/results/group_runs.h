#pragma once

#include <string>
#include <vector>

#include "osteon/procedure/standard.h"
#include "osteon/results/attempt_row.h"

namespace osteon {

/// The attempt of each person of a group that counts when a standard is set.
struct GroupRuns {
  std::vector<std::string> learners;  ///< who has one
  std::vector<Metrics> metrics;       ///< as learners
  std::vector<std::string> without;   ///< who has none, and why: "ada: no whole attempt"
};

enum class CountedAttempt { kFirst, kLast };

/// One attempt of each learner, so that nobody counts twice: the first or the last of those at
/// `scenario` in that version in which every stage was done and no device led the hand. `rows` in
/// the order in which they were made. A learner who is named twice counts once.
GroupRuns runs_of_group(const std::vector<AttemptRow>& rows, const std::string& scenario,
                        int version, const std::vector<std::string>& learners,
                        CountedAttempt counted);

}  // namespace osteon
