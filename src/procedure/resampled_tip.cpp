#include <algorithm>
#include <cmath>

#include "osteon/procedure/path_metrics.h"

namespace osteon {
namespace {

// The polynomial through samples [first, first + count) at time t, by Lagrange's weights
// w_i = prod_{j != i} (t - t_j) / (t_i - t_j).
Vec3 through(const ProbePath& path, std::size_t first, std::size_t count, double t) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = first; i < first + count; ++i) {
    double weight = 1;
    const double t_i = path.samples[i].time_s;
    for (std::size_t j = first; j < first + count; ++j)
      if (j != i) weight *= (t - path.samples[j].time_s) / (t_i - path.samples[j].time_s);
    sum += weight * path.samples[i].X_WD.p;
  }
  return sum;
}

}  // namespace

std::vector<Vec3> resampled_tip(const ProbePath& path, double rate_hz) {
  std::vector<Vec3> tip;
  const std::size_t size = path.samples.size();
  if (size < 2) return tip;
  const std::size_t count = std::min<std::size_t>(4, size);
  const double start_s = path.samples.front().time_s;
  // The last sample counts where rounding puts it a hair before its tick.
  const auto ticks = static_cast<std::size_t>(std::floor(path.duration_s() * rate_hz + 1e-6));
  tip.reserve(ticks + 1);
  std::size_t after = 1;  // first sample later than the tick, or the last one
  for (std::size_t k = 0; k <= ticks; ++k) {
    const double t = start_s + static_cast<double>(k) / rate_hz;
    while (after + 1 < size && path.samples[after].time_s <= t) ++after;
    const std::size_t first = std::min(after >= 2 ? after - 2 : 0, size - count);
    tip.push_back(through(path, first, count, t));
  }
  return tip;
}

std::optional<double> ldlj(const std::vector<Vec3>& p, double rate_hz) {
  if (p.size() < 4) return std::nullopt;
  double peak = 0;
  double integral = 0;
  for (std::size_t i = 1; i < p.size(); ++i)
    peak = std::max(peak, (p[i] - p[i - 1]).norm() * rate_hz);
  const double cubed = rate_hz * rate_hz * rate_hz;
  for (std::size_t i = 3; i < p.size(); ++i) {
    const Vec3 jerk = (p[i] - 3 * p[i - 1] + 3 * p[i - 2] - p[i - 3]) * cubed;
    integral += jerk.squaredNorm() / rate_hz;
  }
  const double T = static_cast<double>(p.size() - 1) / rate_hz;
  // What is left of a steady straight way by rounding is no jerk.
  const double rounding = 1e-12 * peak * rate_hz * rate_hz;
  if (!(peak > 0) || integral <= rounding * rounding * T) return std::nullopt;
  return -std::log(T * T * T / (peak * peak) * integral);
}

}  // namespace osteon
