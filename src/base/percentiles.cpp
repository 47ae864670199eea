#include "osteon/base/percentiles.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {
constexpr double kGrowth = 0.00995033085316808;  // ln(1.01)
}

void Percentiles::add_ns(std::int64_t ns) {
  ns = std::max<std::int64_t>(ns, 1);
  const int bin = static_cast<int>(std::log(static_cast<double>(ns)) / kGrowth);
  ++bins_[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))];
  ++count_;
  max_ = std::max(max_, ns);
}

double Percentiles::quantile_ns(double q) const {
  if (count_ == 0) return 0;
  const double wanted = std::clamp(q, 0.0, 1.0) * static_cast<double>(count_);
  double seen = 0;
  for (int i = 0; i < kBins; ++i) {
    seen += bins_[static_cast<std::size_t>(i)];
    if (seen >= wanted && seen > 0) return std::min(std::exp((i + 1) * kGrowth), max_ns());
  }
  return max_ns();
}

}  // namespace osteon
