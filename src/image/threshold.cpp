#include "osteon/image/threshold.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr int kLowest = -1024, kHighest = 3071;
constexpr int kFatLow = -150, kMuscleLow = -20, kSoftHigh = 200;
constexpr double kMuscleShare = 0.1;  // of the fat's peak, by which muscle's counts
constexpr int kAboveSoft = 120;
constexpr double kFallbackThreshold = 226;  // the usual preset for bone

using Histogram = std::vector<double>;

double& count_of(Histogram& h, int hu) { return h[static_cast<std::size_t>(hu - kLowest)]; }

Histogram histogram_of(const Volume& volume) {
  Histogram h(static_cast<std::size_t>(kHighest - kLowest + 1), 0.0);
  for (const std::int16_t hu : volume.values)
    if (hu > kLowest && hu <= kHighest) ++h[static_cast<std::size_t>(hu - kLowest)];
  return h;
}

struct Peak {
  int hu = 50;
  double count = 0;
};

Peak peak_within(Histogram& h, int low, int high) {
  Peak peak;
  for (int hu = low; hu <= high; ++hu) {
    double sum = 0;
    for (int d = -10; d <= 10; ++d) sum += count_of(h, hu + d);
    if (sum > peak.count) peak = {hu, sum};
  }
  return peak;
}

/// Where there is more fat than muscle, muscle's is still the peak that bone stands in.
int soft_mode(Histogram& h) {
  const Peak any = peak_within(h, kFatLow, kSoftHigh);
  const Peak muscle = peak_within(h, kMuscleLow, kSoftHigh);
  // The tail of the fat's peak is highest where the range of muscle begins.
  const bool is_peak = muscle.hu > kMuscleLow && muscle.count > kMuscleShare * any.count;
  return is_peak ? muscle.hu : any.hu;
}

}  // namespace

BoneLevels find_bone_levels(const Volume& volume) {
  Histogram h = histogram_of(volume);
  BoneLevels levels;
  const int soft = soft_mode(h);
  levels.soft_hu = soft;
  double total = 0, total_sum = 0;
  for (int hu = soft + kAboveSoft; hu <= kHighest; ++hu) {
    total += count_of(h, hu);
    total_sum += count_of(h, hu) * hu;
  }
  double below = 0, below_sum = 0, best = 0, first_best = 0, cut = 2 * kFallbackThreshold - soft;
  for (int hu = soft + kAboveSoft; hu < kHighest; ++hu) {
    below += count_of(h, hu);
    below_sum += count_of(h, hu) * hu;
    const double above = total - below;
    if (below <= 0 || above <= 0) continue;
    const double apart = below_sum / below - (total_sum - below_sum) / above;
    const double between = below * above * apart * apart;
    // Between two classes far apart every cut is as good: the middle one is taken.
    if (between < best * (1 - 1e-9)) continue;
    if (between > best * (1 + 1e-9)) first_best = hu;
    best = std::max(best, between);
    cut = 0.5 * (first_best + hu);
    levels.bone_hu = (total_sum - below_sum) / above;
  }
  levels.threshold_hu = std::round(0.5 * (soft + cut));
  return levels;
}

}  // namespace osteon
