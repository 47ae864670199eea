#pragma once

#include <vector>

namespace osteon {

/// When a learner has shown to be competent: the learning-curve CUSUM (Biau, Williams, Schlup,
/// Nizard, Porcher 2008).
///
///   S <- max(0, S + W);  success W = ln[(1 - p0) / (1 - p0 - d)];  failure W = ln[p0 / (p0 + d)]
///
/// p0: failures that a competent person may have; d: how many more are unacceptable. Competent once
/// S >= h. After that a CUSUM the other way (Page 1954) watches for a relapse: R <- max(0, R - W),
/// a warning at R >= h_relapse.
struct LcCusumOptions {
  double p0 = 0.10;
  double d = 0.15;
  double h = 3.5;
  double h_relapse = 3.5;
};
double success_weight(const LcCusumOptions& options);
double failure_weight(const LcCusumOptions& options);

struct LcCusum {
  std::vector<double> s;        ///< after each attempt
  std::vector<double> relapse;  ///< after each attempt; 0 before competence
  int competent_at = -1;        ///< index of the attempt that showed it; -1: not yet
  int relapse_at = -1;          ///< index of the first attempt with a warning; -1: none
};
/// `passed`, in the order of the attempts.
LcCusum lc_cusum(const std::vector<bool>& passed, const LcCusumOptions& options = {});

}  // namespace osteon
