#include "osteon/procedure/lc_cusum.h"

#include <algorithm>
#include <cmath>

namespace osteon {

double success_weight(const LcCusumOptions& o) { return std::log((1 - o.p0) / (1 - o.p0 - o.d)); }

double failure_weight(const LcCusumOptions& o) { return std::log(o.p0 / (o.p0 + o.d)); }

LcCusum lc_cusum(const std::vector<bool>& passed, const LcCusumOptions& options) {
  LcCusum curve;
  double s = 0, r = 0;
  for (std::size_t i = 0; i < passed.size(); ++i) {
    const double w = passed[i] ? success_weight(options) : failure_weight(options);
    const bool competent = curve.competent_at >= 0;
    s = std::max(0.0, s + w);
    if (competent) r = std::max(0.0, r - w);
    if (!competent && s >= options.h) curve.competent_at = static_cast<int>(i);
    if (curve.relapse_at < 0 && r >= options.h_relapse) curve.relapse_at = static_cast<int>(i);
    curve.s.push_back(s);
    curve.relapse.push_back(r);
  }
  return curve;
}

}  // namespace osteon
