#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// How experts do on one metric.
struct StandardMetric {
  std::string name;
  double mean = 0;
  double sd = 1;  ///< above zero
  double weight = 1;
  bool lower_is_better = true;
};

/// What an exercise is passed against: versioned data, assets/standards/*.toml. Of where its
/// figures come from `source` says.
struct Standard {
  std::string scenario;
  int version = 1;
  std::string source;
  int experts = 0;         ///< runs behind mean and sd; 0: they are defaults
  double reliability = 0;  ///< of the score, 0 to 1: Cronbach's alpha or G
  double score_sd = 10;    ///< of the group that the reliability was found in
  double pass_score = 80;
  std::vector<StandardMetric> metrics;
};

Result<Standard> parse_standard(std::string_view text, const std::string& where);
Result<Standard> load_standard(const std::filesystem::path& file);
/// The same text as its file would hold.
std::string to_toml(const Standard& standard);

/// A score with the range in which the true one lies with 95 %: score -+ 1.96 SEM with
/// SEM = SD sqrt(1 - reliability) (classical test theory).
struct Score {
  double value = 0;
  double lo = 0, hi = 0;
};

using Metrics = std::map<std::string, double>;

/// 100 + 10 times the weighted mean of z over the standard's metrics, z = (value - experts' mean) /
/// experts' SD, turned so that more is better and kept within -6 and 6, less `points` for errors.
/// So experts score 100 on average. Fails on a metric that is missing or not finite.
Result<Score> score_of(const Standard& standard, const Metrics& metrics, double points = 0);

enum class Verdict { kPassed, kNotPassed, kUndecided };
/// "passed", "not_passed", "undecided".
std::string_view to_text(Verdict verdict);
/// Passed when the whole interval is at or above the mark, not passed when all of it is below; else
/// the score does not decide.
Verdict verdict_of(const Standard& standard, const Score& score);

/// Mean and SD (n - 1) of each metric over experts' runs. Fails for fewer than two runs, a metric
/// that a run lacks, or one without spread.
Result<std::vector<StandardMetric>> norm_of(const std::vector<Metrics>& experts,
                                            std::vector<StandardMetric> wanted);

/// The mark of contrasting groups: where the normal curves fitted to both groups' scores cross
/// between their means (Berk 1976; Jorgensen et al. 2018), with the shares that it judges wrongly
/// by those curves. Fails for fewer than two scores in a group, groups without spread or in the
/// wrong order.
struct ContrastingMark {
  double mark = 0;
  double experts_failed = 0;  ///< share of experts below
  double novices_passed = 0;  ///< share of novices at or above
};
Result<ContrastingMark> contrasting_groups(const std::vector<double>& experts,
                                           const std::vector<double>& novices);

/// Cronbach's alpha of rows of persons and columns of items (Cronbach 1951). Fails for fewer than
/// two of either, rows of unequal length, or totals without spread.
Result<double> cronbach_alpha(const std::vector<std::vector<double>>& persons);

/// Share of pairs (expert, novice) that the score puts in the right order, ties half: the area
/// under the ROC curve (Mann and Whitney). Fails for an empty group.
Result<double> area_under_curve(const std::vector<double>& experts,
                                const std::vector<double>& novices);

}  // namespace osteon
