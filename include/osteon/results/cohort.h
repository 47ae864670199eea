#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/procedure/lc_cusum.h"
#include "osteon/results/attempt_row.h"
#include "osteon/results/names.h"

namespace osteon {

/// One learner at one exercise.
struct CohortLearner {
  std::string learner;
  std::size_t attempts = 0, passed = 0;
  std::optional<double> first_score;             ///< of the first attempt that has one
  std::optional<double> last, last_lo, last_hi;  ///< of the last that has one, with its interval
  int competent_at = -1, relapse_at = -1;        ///< attempt, see lc_cusum; -1: not
};
/// An error of an exercise: how often a class made it.
struct CohortError {
  std::string name, severity;
  std::size_t attempts = 0;  ///< in which it was made
  std::size_t learners = 0;  ///< who made it
};
/// Scores of a class at their n-th attempt.
struct CohortStep {
  std::size_t learners = 0;                 ///< who have one with a score
  double median = 0, lower = 0, upper = 0;  ///< with the quartiles (type 7 of Hyndman and Fan 1996)
};
struct CohortScenario {
  std::string name;
  std::size_t attempts = 0, passed = 0;
  std::vector<CohortLearner> learners;  ///< by id
  std::vector<CohortError> errors;      ///< the most frequent first, then by name
  std::vector<CohortStep> curve;        ///< by attempt, from the first on
};
/// A class at each exercise, by name.
using Cohort = std::vector<CohortScenario>;

/// Of attempts in the order in which they were made. One whose report cannot be read counts, but
/// its errors are not known.
Cohort cohort_of(const std::vector<AttemptRow>& rows, const LcCusumOptions& options = {});

/// One page, HTML with its pictures in it and nothing from elsewhere. Learners by their id, and by
/// name where `names` has one.
std::string to_html(const Cohort& cohort, const LearnerNames& names = {});
/// The same as PDF.
Result<void> save_cohort_pdf(const Cohort& cohort, const LearnerNames& names,
                             const std::filesystem::path& file);
std::string to_json(const Cohort& cohort);

/// What tells two attempts apart, JSON: `a` and `b` (learner, verdict, score with its interval,
/// time), `metrics[].{name, a, b, change}`, `stages[].{name, a_s, b_s}`, and errors made in one
/// (`only_a`, `only_b`) or both. `same_scenario` says whether they can be compared at all.
Result<std::string> compare_attempts(const AttemptRow& a, const AttemptRow& b);

}  // namespace osteon
