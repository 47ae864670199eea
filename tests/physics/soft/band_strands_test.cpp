// A band as strands: how deep it is cut for what is left of it, and which of them tears next.
#include "osteon/physics/band_strands.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "soft/notched_band.h"

namespace osteon {
namespace {

SoftBand strand_band() {
  SoftBand band;
  band.radius_m = 0.003;
  band.section_B = Vec3::UnitY();
  return band;
}
const BandSpan kStrandSpan{{0, 0, 0}, {0.03, 0, 0}};
Vec3 towards(double turn) { return {0, std::cos(turn), std::sin(turn)}; }

// A round section that is cut straight across to the depth d keeps 1 - (t - sin t) / 2 pi of its
// area, cos(t / 2) = 1 - d / r. The strands are a hexagon in layers.
double left_of_round(double deep_m, double radius_m) {
  const double t = 2 * std::acos(std::clamp(1 - deep_m / radius_m, -1.0, 1.0));
  return 1 - (t - std::sin(t)) / (2 * std::numbers::pi);
}

TEST(BandStrands, CutFromAnySideItIsARoundSectionCutAcross) {
  const SoftBand band = strand_band();
  const StrandAxes section = section_of(band, kStrandSpan, Pose{});
  const double layer_m = 2 * band.radius_m / 9;
  for (double turn = 0; turn < 2 * std::numbers::pi; turn += 0.37) {
    const Vec3 n = towards(turn);
    std::uint64_t gone = 0;
    EXPECT_EQ(hollow_m(band, gone, section, n), 0);
    for (int i = 0; i < kStrands - 1; ++i) {
      gone |= std::uint64_t{1} << strand_under(gone, section, n);
      const double deep = hollow_m(band, gone, section, n), left = strands_left(gone);
      EXPECT_NEAR(left, 1 - (i + 1.0) / kStrands, 1e-12);
      EXPECT_LE(left, left_of_round(deep - layer_m, band.radius_m) + 0.06) << turn << " " << i;
      EXPECT_GE(left, left_of_round(deep + layer_m, band.radius_m) - 0.06) << turn << " " << i;
    }
    gone |= std::uint64_t{1} << strand_under(gone, section, n);
    EXPECT_EQ(gone, kAllStrands);
  }
}

// From the other side nothing is gone until the edge comes through.
TEST(BandStrands, TheOtherSideStaysWhereItIs) {
  const SoftBand band = strand_band();
  const StrandAxes section = section_of(band, kStrandSpan, Pose{});
  std::uint64_t gone = 0;
  for (int i = 0; i < 45; ++i) {
    gone |= std::uint64_t{1} << strand_under(gone, section, Vec3::UnitZ());
    EXPECT_EQ(hollow_m(band, gone, section, -Vec3::UnitZ()), 0) << i;
  }
  EXPECT_GT(hollow_m(band, gone, section, Vec3::UnitZ()), band.radius_m);
}

TEST(BandStrands, EachBearsAnotherLoadAndTheWeakestGoesFirst) {
  std::uint64_t gone = 0;
  double before = 1 - 1e-9;
  std::set<double> all;
  for (int i = 0; i < kStrands; ++i) {
    const int next = weakest_strand(gone);
    EXPECT_GE(strand_strength(next), before);
    before = strand_strength(next);
    all.insert(before);
    gone |= std::uint64_t{1} << next;
    // What the rest bears is never more than the whole did.
    if (i + 1 == kStrands) break;
    EXPECT_LT(strands_left(gone) * strand_strength(weakest_strand(gone)), 1);
  }
  EXPECT_EQ(all.size(), static_cast<std::size_t>(kStrands));
  EXPECT_EQ(*all.begin(), 1);
  EXPECT_DOUBLE_EQ(*all.rbegin(), 1.25);
  EXPECT_EQ(weakest_strand(gone), -1);
}

// Seen, it has a groove where it is cut, as deep as it is cut, and is whole elsewhere.
TEST(BandStrands, TheGrooveIsAsDeepAsItIsCut) {
  const SoftBand band = strand_band();
  const StrandAxes section = section_of(band, kStrandSpan, Pose{});
  BandNotch notch{0, 0.4, 0};
  for (int i = 0; i < 25; ++i)
    notch.gone |= std::uint64_t{1} << strand_under(notch.gone, section, Vec3::UnitZ());
  const double at = 0.4 * 0.03, r = band.radius_m;
  const std::vector<Vec3> before = {{at, 0, r}, {at, 0, -r}, {at + 0.006, 0, r}, {-0.001, 0, r}};
  const std::vector<Vec3> after = notched_points(before, band, kStrandSpan, section, notch);
  const double deep = hollow_m(band, notch.gone, section, Vec3::UnitZ());
  EXPECT_GT(deep, 0.5 * r);
  EXPECT_NEAR((after[0] - Vec3(at, 0, r - deep)).norm(), 0, 1e-12);
  for (std::size_t i = 1; i < before.size(); ++i) EXPECT_EQ(after[i], before[i]) << i;
}

}  // namespace
}  // namespace osteon
