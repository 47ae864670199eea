#include <algorithm>
#include <cmath>

#include "osteon/procedure/standard.h"
#include "spread.h"

namespace osteon {
namespace {

double share_below(double x, const SampleSpread& s) {
  return 0.5 * std::erfc(-(x - s.mean) / (s.sd * std::sqrt(2.0)));
}

double log_density(double x, const SampleSpread& s) {
  const double z = (x - s.mean) / s.sd;
  return -0.5 * z * z - std::log(s.sd);
}

}  // namespace

Result<std::vector<StandardMetric>> norm_of(const std::vector<Metrics>& experts,
                                            std::vector<StandardMetric> wanted) {
  if (experts.size() < 2)
    return fail("a norm needs two runs of experts", "norm", "Record more runs");
  for (StandardMetric& metric : wanted) {
    std::vector<double> values;
    for (const Metrics& run : experts) {
      const auto found = run.find(metric.name);
      if (found == run.end() || !std::isfinite(found->second))
        return fail("a run has no metric '" + metric.name + "'", "norm");
      values.push_back(found->second);
    }
    const SampleSpread spread = spread_of(values);
    if (!(spread.sd > 0))
      return fail("all runs have the same '" + metric.name + "'", "norm", "Leave the metric out");
    metric.mean = spread.mean;
    metric.sd = spread.sd;
  }
  return wanted;
}

// The difference of the logarithms of both densities is above 0 at the experts' mean when the
// groups are apart and falls to below 0 at the novices': halving the interval keeps that, until it
// is as small as rounding.
Result<ContrastingMark> contrasting_groups(const std::vector<double>& experts,
                                           const std::vector<double>& novices) {
  if (experts.size() < 2 || novices.size() < 2)
    return fail("each group needs two scores", "contrasting groups");
  const SampleSpread e = spread_of(experts), n = spread_of(novices);
  // Of equal scores the rounding of their mean leaves a spread as well.
  const auto spreads = [](const SampleSpread& s) { return s.sd > 1e-9 * (1 + std::abs(s.mean)); };
  if (!spreads(e) || !spreads(n))
    return fail("a group's scores are all the same", "contrasting groups");
  double hi = e.mean, lo = n.mean;
  const auto expert_likelier = [&](double x) { return log_density(x, e) > log_density(x, n); };
  if (!(hi > lo) || !expert_likelier(hi) || expert_likelier(lo))
    return fail("the groups' scores do not differ", "contrasting groups",
                "A score that does not separate them cannot set a mark");
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (lo + hi);
    (expert_likelier(middle) ? hi : lo) = middle;
  }
  return ContrastingMark{hi, share_below(hi, e), 1 - share_below(hi, n)};
}

Result<double> cronbach_alpha(const std::vector<std::vector<double>>& persons) {
  if (persons.size() < 2 || persons[0].size() < 2)
    return fail("reliability needs two persons and two items", "reliability");
  const std::size_t items = persons[0].size();
  std::vector<double> totals(persons.size(), 0);
  double variances = 0;
  for (std::size_t i = 0; i < items; ++i) {
    std::vector<double> column;
    for (std::size_t p = 0; p < persons.size(); ++p) {
      if (persons[p].size() != items)
        return fail("a person has a different number of items", "reliability");
      column.push_back(persons[p][i]);
      totals[p] += persons[p][i];
    }
    const double sd = spread_of(column).sd;
    variances += sd * sd;
  }
  const double sd = spread_of(totals).sd;
  if (!(sd > 0)) return fail("all persons have the same total", "reliability");
  const double k = static_cast<double>(items);
  return k / (k - 1) * (1 - variances / (sd * sd));
}

Result<double> area_under_curve(const std::vector<double>& experts,
                                const std::vector<double>& novices) {
  if (experts.empty() || novices.empty()) return fail("a group is empty", "area under the curve");
  double right = 0;
  for (const double e : experts)
    for (const double n : novices) right += e > n ? 1.0 : e == n ? 0.5 : 0.0;
  return right / (static_cast<double>(experts.size()) * static_cast<double>(novices.size()));
}

}  // namespace osteon
