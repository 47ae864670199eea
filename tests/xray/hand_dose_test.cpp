#include "osteon/xray/hand_dose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "osteon/xray/picture.h"
#include "phantoms.h"

namespace osteon {
namespace {

using testing_xray::box;
using testing_xray::layer;
using testing_xray::view_from_above;

constexpr double kDegree = std::numbers::pi / 180;

XrayExposure exposure_of(double kv) {
  XrayExposure exposure;
  exposure.kv = kv;
  exposure.mas = 2;
  exposure.shots = 5;
  return exposure;
}

XrayBody slab(double half_m, double thick_m) {
  XrayBody body;
  body.layers.push_back(
      layer(box(Vec3(-half_m, -half_m, -thick_m / 2), Vec3(half_m, half_m, thick_m / 2)), 1,
            XraySubstance::kSoft));
  return body;
}

TEST(HandDose, RefusesAPlaceThatIsNone) {
  const XrayView view = view_from_above();
  const auto density = *areal_density(slab(0.02, 0.01), view);
  const Vec3 nowhere(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_FALSE(hand_dose(slab(0.02, 0.01), view, density, exposure_of(70), nowhere, 0.6));
}

TEST(HandDose, FractionsAreTheTablesAndStraightBetween) {
  EXPECT_NEAR(scatter_fraction(70, 90 * kDegree), 0.0005, 1e-15);
  EXPECT_NEAR(scatter_fraction(100, 135 * kDegree), 0.0022, 1e-15);
  EXPECT_NEAR(scatter_fraction(85, 90 * kDegree), (0.0005 + 0.0013) / 2, 1e-12);
  EXPECT_NEAR(scatter_fraction(50, 75 * kDegree), (0.00025 + 0.00035) / 2, 1e-12);
  EXPECT_EQ(scatter_fraction(40, 0), scatter_fraction(50, 30 * kDegree));
  EXPECT_EQ(scatter_fraction(200, std::numbers::pi), scatter_fraction(125, 135 * kDegree));
}

TEST(HandDose, NothingInTheBeamScattersNothing) {
  const XrayView view = view_from_above();
  XrayBody aside = slab(0.01, 0.01);
  aside.layers[0].surfaces[0].X_WM.p = Vec3(1, 0, 0);
  const auto density = *areal_density(aside, view);
  const auto hand = hand_dose(aside, view, density, exposure_of(70), Vec3(0.4, 0, 0), 0.6);
  ASSERT_TRUE(hand);
  EXPECT_FALSE(hand->in_beam);
  EXPECT_EQ(hand->total_mgy(), 0);
}

// A slab of 20 mm that a beam of 61 mm surrounds, and a hand a metre aside, at right angles.
TEST(HandDose, ScatterIsTheKermaAreaProductOfWhatIsHitByTheInverseSquareOfTheDistance) {
  const XrayView view = view_from_above();
  const XrayBody body = slab(0.010, 0.002);
  const auto density = *areal_density(body, view);
  const XrayExposure exposure = exposure_of(70);
  const double kerma = dose_of(exposure, view).air_kerma_mgy;
  const double kap_mgy_cm2 = kerma * std::pow(kDoseDistance_m / 0.6, 2) * 2 * 2;
  for (const double far_m : {0.5, 1.0}) {
    const auto hand = hand_dose(body, view, density, exposure, Vec3(far_m, 0, 0), 0.6);
    ASSERT_TRUE(hand);
    EXPECT_FALSE(hand->in_beam);
    EXPECT_EQ(hand->direct_mgy, 0);
    const double want = 0.0005 * kap_mgy_cm2 / 400 / (far_m * far_m);
    EXPECT_NEAR(hand->scattered_mgy, want, 0.03 * want) << far_m;
  }
}

TEST(HandDose, MoreScattersBackToTheTubeThanAside) {
  const XrayView view = view_from_above();
  const XrayBody body = slab(0.02, 0.01);
  const auto density = *areal_density(body, view);
  const auto at = [&](const Vec3& p_W) {
    return hand_dose(body, view, density, exposure_of(70), p_W, 0.6)->scattered_mgy;
  };
  EXPECT_GT(at(Vec3(0.2, 0, 0.2)), 1.5 * at(Vec3(std::hypot(0.2, 0.2), 0, 0)));
  // So near that the tissue is no point, it does not rise without bound.
  EXPECT_LT(at(Vec3(0, 0.02, 0)), dose_of(exposure_of(70), view).air_kerma_mgy);
}

TEST(HandDose, InTheBeamItIsTheTubesKermaBehindWhatLiesBefore) {
  const XrayView view = view_from_above();
  const double thick_m = 0.05;
  const XrayBody body = slab(0.08, thick_m);
  const auto density = *areal_density(body, view);
  const XrayExposure exposure = exposure_of(90);
  const double kerma = dose_of(exposure, view).air_kerma_mgy;
  const auto before = hand_dose(body, view, density, exposure, Vec3(0, 0, 0.3), 0.6);
  ASSERT_TRUE(before);
  EXPECT_TRUE(before->in_beam);
  EXPECT_NEAR(before->direct_mgy, kerma * std::pow(0.75 / 0.3, 2), 1e-9 * kerma);
  EXPECT_GT(before->scattered_mgy, 0);
  const auto behind = hand_dose(body, view, density, exposure, Vec3(0, 0, -0.2), 0.6);
  ASSERT_TRUE(behind);
  double through = 0, all = 0;  // energy
  const XraySpectrum spectrum = *tube_spectrum(90);
  for (const auto& bin : spectrum.bins) {
    const double mu = mass_attenuation_cm2_per_g(XraySubstance::kSoft, bin.energy_kev);
    all += bin.share * bin.energy_kev;
    through += bin.share * bin.energy_kev * std::exp(-mu * 100 * thick_m);
  }
  const double want = kerma * std::pow(0.75 / 0.8, 2) * through / all;
  EXPECT_NEAR(behind->direct_mgy, want, 1e-3 * want);
  // Beside the detector's cone, and behind the detector, it meets no beam.
  for (const Vec3& outside : {Vec3(0.04, 0, 0), Vec3(0, 0, -0.5), Vec3(0, 0, 0.7)})
    EXPECT_FALSE(hand_dose(body, view, density, exposure, outside, 0.6)->in_beam) << outside;
}

}  // namespace
}  // namespace osteon
