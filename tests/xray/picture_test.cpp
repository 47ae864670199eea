#include "osteon/xray/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "osteon/xray/dose.h"
#include "phantoms.h"

namespace osteon {
namespace {

ArealDensity flat(std::size_t pixels, XraySubstance substance, float g_per_cm2) {
  ArealDensity density{static_cast<int>(pixels), 1, {}};
  for (auto& values : density.of) values.assign(pixels, 0);
  density.of[static_cast<std::size_t>(substance)].assign(pixels, g_per_cm2);
  return density;
}

TEST(Attenuation, IsThatOfTheTablesRowsAndFallsBetweenThem) {
  const auto at60 = [](XraySubstance s) { return mass_attenuation_cm2_per_g(s, 60); };
  EXPECT_NEAR(at60(XraySubstance::kBone), 0.315, 5e-4);
  EXPECT_NEAR(at60(XraySubstance::kSoft), 0.205, 5e-4);
  EXPECT_NEAR(at60(XraySubstance::kTitanium), 0.766, 5e-4);
  EXPECT_NEAR(at60(XraySubstance::kIron), 1.205, 5e-4);
  double last = 1e9;
  for (double e = 10; e <= 150; e += 1) {
    const double mu = mass_attenuation_cm2_per_g(XraySubstance::kBone, e);
    EXPECT_LT(mu, last);
    last = mu;
  }
  EXPECT_EQ(mass_attenuation_cm2_per_g(XraySubstance::kBone, 5),
            mass_attenuation_cm2_per_g(XraySubstance::kBone, 10));
}

TEST(Attenuation, DensityFollowsHu) {
  EXPECT_NEAR(density_from_hu(-1000), 0.001, 1e-9);
  EXPECT_EQ(density_from_hu(-5000), 0);
  EXPECT_NEAR(density_from_hu(0), 1.03, 1e-9);
  EXPECT_NEAR(density_from_hu(1500), 1.03 + 0.0005886 * 1500, 1e-9);
  EXPECT_EQ(material_of_hu(1500).substance, XraySubstance::kBone);
  EXPECT_EQ(material_of_hu(55).substance, XraySubstance::kSoft);
}

TEST(Spectrum, RefusesAVoltageOutOfRange) {
  EXPECT_FALSE(tube_spectrum(10));
  EXPECT_FALSE(tube_spectrum(500));
  EXPECT_FALSE(tube_spectrum(std::nan("")));
  EXPECT_FALSE(tube_spectrum(60, -1));
}

TEST(Spectrum, HardensWithVoltageAndFilter) {
  const auto mean_kev = [](double kv, double filter_mm) {
    double sum = 0, shares = 0;
    const XraySpectrum spectrum = *tube_spectrum(kv, filter_mm);
    for (const auto& bin : spectrum.bins) {
      EXPECT_LT(bin.energy_kev, kv);
      sum += bin.share * bin.energy_kev;
      shares += bin.share;
    }
    EXPECT_NEAR(shares, 1, 1e-12);
    return sum;
  };
  EXPECT_LT(mean_kev(60, 3.5), mean_kev(90, 3.5));
  EXPECT_LT(mean_kev(60, 1), mean_kev(60, 3.5));
  EXPECT_NEAR(mean_kev(60, 3.5), 38, 4);  // tubes of 60 kV and 3.5 mm of aluminium: 36 to 40
}

TEST(Transmitted, OneEnergyIsTheExponentialOfTheSum) {
  const XraySpectrum one = {{{60, 1}}};
  ArealDensity density = flat(3, XraySubstance::kBone, 2.5f);
  density.of[static_cast<std::size_t>(XraySubstance::kSoft)] = {0, 3, 10};
  const std::vector<float> got = transmitted(density, one);
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_NEAR(got[n], std::exp(-2.5 * 0.3148 - density.of[0][n] * 0.2048), 1e-6);
}

TEST(Transmitted, ASpectrumIsWeightedByEnergy) {
  const XraySpectrum two = {{{40, 0.5}, {80, 0.5}}};
  const std::vector<float> got = transmitted(flat(1, XraySubstance::kIron, 1), two);
  EXPECT_NEAR(got[0], (40 * std::exp(-3.629) + 80 * std::exp(-0.5952)) / 120, 1e-6);
}

TEST(Transmitted, MetalIsDarkerThanAsMuchBone) {
  const auto spectrum = tube_spectrum(60);
  const auto through = [&](XraySubstance s) { return transmitted(flat(1, s, 2), *spectrum)[0]; };
  EXPECT_LT(through(XraySubstance::kIron), through(XraySubstance::kTitanium));
  EXPECT_LT(through(XraySubstance::kTitanium), through(XraySubstance::kBone));
  EXPECT_LT(through(XraySubstance::kBone), through(XraySubstance::kSoft));
}

TEST(Detected, NoiseIsPoissonOfThePhotonsCaught) {
  XrayDetector detector;
  detector.blur = false;
  for (const double share : {1.0, 0.1, 0.001}) {
    const std::vector<float> got =
        detected(std::vector<float>(40000, static_cast<float>(share)), 200, detector);
    double mean = 0, square = 0;
    for (const float s : got) {
      mean += s / 40000.0;
      square += static_cast<double>(s) * s / 40000.0;
    }
    const double variance = share / detector.photons;
    EXPECT_NEAR(mean, share, 5 * std::sqrt(variance / 40000));
    EXPECT_NEAR(square - mean * mean, variance, 0.05 * variance);
  }
}

TEST(Detected, TheSameSeedGivesTheSameBits) {
  const std::vector<float> in(100, 0.3f);
  XrayDetector detector;
  EXPECT_EQ(detected(in, 10, detector), detected(in, 10, detector));
  const std::vector<float> first = detected(in, 10, detector);
  detector.seed = 2;
  EXPECT_NE(first, detected(in, 10, detector));
}

TEST(Detected, BlurSpreadsAPointToItsNeighboursAndKeepsTheLight) {
  std::vector<float> in(25, 0);
  in[12] = 16;
  XrayDetector detector;
  detector.noise = false;
  const std::vector<float> got = detected(in, 5, detector);
  const std::vector<float> want = {0, 0, 0, 0, 0, 0, 1, 2, 1, 0, 0, 2, 4,
                                   2, 0, 0, 1, 2, 1, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(got, want);
}

/// Nothing in the way of any pixel.
ArealDensity no_density(int width, int height) {
  ArealDensity density;
  density.width = width;
  density.height = height;
  for (std::vector<float>& of : density.of)
    of.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0f);
  return density;
}

std::vector<float>& of(ArealDensity& density, XraySubstance substance) {
  return density.of[static_cast<std::size_t>(substance)];
}

TEST(Window, SpansWhatIsCoveredAndGreyTellsAttenuation) {
  std::vector<float> signal;
  ArealDensity density = no_density(1000, 1);
  for (int n = 0; n < 1000; ++n) {
    signal.push_back(static_cast<float>(std::exp(-0.004 * n)));
    of(density, XraySubstance::kSoft)[static_cast<std::size_t>(n)] = n == 0 ? 0.0f : 1.0f;
  }
  const XrayWindow window = automatic_window(signal, density);
  EXPECT_NEAR(window.bright, std::exp(-0.004 * 5), 0.01);
  EXPECT_NEAR(window.dark, std::exp(-0.004 * 995), 0.001);
  const std::vector<float> grey = shown(signal, window);
  EXPECT_EQ(grey.front(), 1);
  EXPECT_EQ(grey.back(), 0);
  EXPECT_NEAR(grey[250] - grey[350], grey[550] - grey[650], 1e-5);
  EXPECT_EQ(automatic_window(signal, no_density(1000, 1)).bright, 1);
}

// Flesh on the left, bone on the right, and a steel bar of every width across both.
TEST(Window, SteelBesideBoneLeavesBoneEasyToSeeAndIsDarkerThanIt) {
  const auto spectrum = tube_spectrum(70);
  ASSERT_TRUE(spectrum);
  XrayDetector still;
  still.noise = false;
  const auto picture = [&](int bar_rows) {
    ArealDensity density = no_density(60, 60);
    for (int row = 0; row < 60; ++row)
      for (int column = 0; column < 60; ++column) {
        const auto n = static_cast<std::size_t>(60 * row + column);
        of(density, XraySubstance::kSoft)[n] = 8;
        if (column >= 30) of(density, XraySubstance::kBone)[n] = 3;
        if (row >= 10 && row < 10 + bar_rows) of(density, XraySubstance::kIron)[n] = 8;
      }
    const std::vector<float> signal = detected(transmitted(density, *spectrum), 60, still);
    return shown(signal, automatic_window(signal, density));
  };
  EXPECT_NEAR(picture(0)[60u * 55 + 50], 0, 0.01) << "the darkest of all";
  for (const int rows : {1, 5, 40}) {
    const std::vector<float> grey = picture(rows);
    EXPECT_NEAR(grey[60u * 55 + 10], 1, 0.01) << "flesh, " << rows << " rows of steel";
    EXPECT_NEAR(grey[60u * 55 + 50], 1 / 7., 0.01) << "bone, " << rows << " rows of steel";
    EXPECT_EQ(grey[60u * 10 + 50], 0) << "steel on bone";
  }
}

TEST(Window, SteelAloneIsShownByItself) {
  ArealDensity density = no_density(100, 1);
  std::vector<float> signal(100, 0.3f);
  for (std::size_t n = 0; n < 100; ++n) {
    of(density, XraySubstance::kIron)[n] = 1;
    signal[n] = static_cast<float>(std::exp(-0.05 * static_cast<double>(n)));
  }
  const XrayWindow window = automatic_window(signal, density);
  EXPECT_NEAR(window.bright, 1, 0.1);
  EXPECT_NEAR(window.dark, std::exp(-0.05 * 99), 0.001);
}

TEST(Dose, KermaIsTheTablesAndRisesBetween) {
  EXPECT_NEAR(kerma_mgy_per_mas(60), 0.069, 1e-12);
  EXPECT_NEAR(kerma_mgy_per_mas(90), 0.138, 1e-12);
  EXPECT_NEAR(kerma_mgy_per_mas(120), 0.224, 1e-12);
  for (double kv = 41; kv <= 120; ++kv) EXPECT_GT(kerma_mgy_per_mas(kv), kerma_mgy_per_mas(kv - 1));
}

TEST(Dose, KermaAreaProductIsTheSameAtTheDetector) {
  XrayExposure exposure;
  exposure.kv = 90;
  exposure.mas = 2;
  exposure.shots = 5;
  exposure.pulse_s = 0.02;
  const XrayView view = testing_xray::view_from_above(200, 0.001);  // 20 cm by 20 cm at 1 m
  const XrayDose dose = dose_of(exposure, view);
  EXPECT_NEAR(dose.air_kerma_mgy, 0.138 * 2 * 5, 1e-12);
  EXPECT_NEAR(dose.beam_area_cm2, 225, 1e-9);
  EXPECT_NEAR(dose.kerma_area_mgy_cm2, 0.138 * 10 * 225, 1e-9);
  EXPECT_NEAR(dose.seconds, 0.1, 1e-12);
  // At the detector the kerma falls with the square of the distance, the area grows with it.
  EXPECT_NEAR(dose.kerma_area_mgy_cm2, dose.air_kerma_mgy * 0.75 * 0.75 * 400, 1e-9);
}

TEST(Dose, AutomaticExposureGivesTheDetectorAsMuchLight) {
  EXPECT_NEAR(automatic_mas(1, 0.02, 5), 0.02, 1e-12);
  EXPECT_NEAR(automatic_mas(0.1, 0.02, 5) * 0.1, 0.02, 1e-12);
  EXPECT_EQ(automatic_mas(1e-9, 0.02, 5), 5);
  EXPECT_EQ(automatic_mas(0, 0.02, 5), 5);
  std::vector<float> values(64, 1);
  for (const int n : {18, 19, 20, 21, 26, 27, 28, 29, 34, 35, 36, 37, 42, 43, 44, 45})
    values[static_cast<std::size_t>(n)] = 0.5f;
  EXPECT_NEAR(mean_in_middle(values, 8), 0.5, 1e-6);
  EXPECT_EQ(mean_in_middle({}, 8), 0);
}

}  // namespace
}  // namespace osteon
