#include "osteon/scene/graft.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "graft_form.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kMuscleEnd_m = 0.010;  // trimmed off
constexpr std::uint32_t kMostFolds = 4;
constexpr double kMeanHeight_m = 1.75;
constexpr double kLeastTendon_m = 0.15, kMostTendon_m = 0.42;
// Within rounding of a sizer's bore.
constexpr double kSameBore_m = 1e-7;

double bundle_m(double area_m2) {
  return std::sqrt(4 * area_m2 / (std::numbers::pi * kBundleFilled));
}

// A share of all that four strands of both make.
constexpr double kSemitendinosusShare = 0.62;
double strand_area(double four_strands_m, double share) {
  return share * 0.5 * kBundleFilled * 0.25 * std::numbers::pi * four_strands_m * four_strands_m;
}

void put_bands(Random& random, std::uint32_t least, std::uint32_t most, TendonMeasures& tendon) {
  tendon.bands = least;
  for (std::uint32_t n = least; n < most; ++n) tendon.bands += random.uniform() < 0.5 ? 1 : 0;
  for (std::uint32_t b = 0; b < tendon.bands; ++b) tendon.bands_m[b] = random.uniform(0.045, 0.100);
  std::sort(tendon.bands_m.begin(), tendon.bands_m.begin() + tendon.bands);
}

}  // namespace

Result<std::array<TendonMeasures, kGraftTendons>> tendons_of(double height_m, std::uint64_t seed) {
  if (!(height_m >= 1.2 && height_m <= 2.2))
    return fail("a height of " + std::to_string(height_m) + " m is outside of 1.2 to 2.2 m",
                "height", "Give the patient's height in m");
  Random random(seed * 2654435761u + 41);
  const double taller = height_m / kMeanHeight_m;
  std::array<TendonMeasures, kGraftTendons> out;
  // The spread over people is that of the source; part of it is their height.
  out[0].length_m = std::clamp(taller * random.normal(0.289, 0.031), kLeastTendon_m, kMostTendon_m);
  out[1].length_m = std::clamp(taller * random.normal(0.277, 0.030), kLeastTendon_m, kMostTendon_m);
  const double mean_mm = 7.9 + 3.0 * (height_m - kMeanHeight_m);
  const double four_m = 1e-3 * std::clamp(random.normal(mean_mm, 0.7), 5.5, 11.0);
  out[0].area_m2 = strand_area(four_m, kSemitendinosusShare);
  out[1].area_m2 = strand_area(four_m, 1 - kSemitendinosusShare);
  put_bands(random, 1, 2, out[0]);
  put_bands(random, 0, 3, out[1]);
  return out;
}

HarvestedTendon strip(const TendonMeasures& tendon, std::uint32_t cut) {
  for (std::uint32_t b = 0; b < std::min<std::size_t>(tendon.bands, kMostBands); ++b)
    if ((cut & (1u << b)) == 0) return {tendon.bands_m[b], tendon.area_m2, true};
  return {tendon.length_m, tendon.area_m2, false};
}

HarvestedTendon with_muscle(HarvestedTendon tendon, double left) {
  constexpr double kThicker = 1.0 / 3;
  tendon.area_m2 *= 1 + kThicker * std::clamp(left, 0.0, 1.0);
  return tendon;
}

Result<Graft> fold_graft(std::span<const std::optional<HarvestedTendon>> tendons,
                         std::span<const std::uint32_t> folds) {
  Graft graft;
  double area = 0, length = 0;
  for (std::size_t t = 0; t < std::min(tendons.size(), folds.size()); ++t) {
    if (folds[t] > kMostFolds)
      return fail("a tendon cannot be folded to " + std::to_string(folds[t]) + " strands", "graft",
                  "Use 1 to 4");
    if (folds[t] == 0 || !tendons[t]) continue;
    const double strand = std::max(0.0, tendons[t]->length_m - kMuscleEnd_m) / folds[t];
    length = graft.strands == 0 ? strand : std::min(length, strand);
    area += folds[t] * tendons[t]->area_m2;
    graft.strands += folds[t];
  }
  if (graft.strands == 0)
    return fail("no tendon is folded", "graft", "Harvest one and say how many strands it makes");
  graft.length_m = length;
  graft.diameter_m = bundle_m(area);
  graft.sized_m = sizer_for(graft.diameter_m);
  return graft;
}

double sizer_for(double diameter_m) {
  const double steps = std::ceil((diameter_m - kLeastSizer_m - kSameBore_m) / kSizerStep_m);
  const double bore = kLeastSizer_m + kSizerStep_m * std::max(0.0, steps);
  return bore <= kMostSizer_m + kSameBore_m ? bore : 0;
}

LoopFit fit_loop(double channel_m, double socket_m, double loop_m) {
  const double inside = channel_m - loop_m;
  return {inside, inside + kFlipRoom_m <= socket_m + kSameBore_m && inside > 0};
}

double creep_left(double at_80_n_s, double cycles) {
  constexpr double kDies_s = 240, kDiesCycles = 15;
  return std::exp(-at_80_n_s / kDies_s - cycles / kDiesCycles);
}

double loop_for(double channel_m, double socket_m) {
  for (int mm = 15; mm <= 50; mm += 5)
    if (fit_loop(channel_m, socket_m, 1e-3 * mm).flips) return 1e-3 * mm;
  return 0;
}

}  // namespace osteon
