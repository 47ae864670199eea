// A ball's scan is known by geometry alone.
#include "osteon/anatomy/virtual_scan.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "osteon/mesh/isosurface.h"

namespace osteon {
namespace {

constexpr double kRadius_m = 0.006;

const TriMesh& ball() {
  static const TriMesh mesh = *isosurface([](const Vec3& p) { return p.norm() - kRadius_m; },
                                          {Vec3::Constant(-0.008), Vec3::Constant(0.008)}, {});
  return mesh;
}

ScanOptions quiet() {
  ScanOptions options;
  options.noise_hu = 0;
  options.psf_m = 0;
  options.flesh_m = 0.003;
  return options;
}

Result<Volume> scan(const ScanOptions& options, const Pose& X_WB = {}) {
  const ScannedBone bone{&ball(), X_WB};
  return virtual_scan(std::span(&bone, 1), *load_default_tissues(), options);
}

TEST(VirtualScan, TissuesLieWhereTheirDistanceSaysInPatient) {
  Pose X_WB;
  X_WB.p = Vec3(0.01, 0.02, 0.03);
  const auto volume = scan(quiet(), X_WB);
  ASSERT_TRUE(volume) << volume.error().message();
  // World x is Patient z, World y is Patient x, World z is Patient y.
  const Vec3 center_P(0.02, 0.03, 0.01);
  const auto at = [&](double r) {
    return sample_linear(*volume, volume->frame.voxel(center_P + Vec3(0, 0, r)));
  };
  EXPECT_NEAR(at(0), 350, 1);
  EXPECT_NEAR(at(kRadius_m - 0.0006), 1500, 60);
  EXPECT_NEAR(at(kRadius_m + 0.0010), 55, 20);
  EXPECT_NEAR(at(kRadius_m + 0.0050), -1000, 1);
}

// The mean over voxels is that over space, however coarse the voxels are.
TEST(VirtualScan, PartialVolumeKeepsTheAmountOfEachTissue) {
  for (const double slice_m : {0.0005, 0.002}) {
    ScanOptions options = quiet();
    options.slice_m = slice_m;
    const auto volume = scan(options);
    ASSERT_TRUE(volume);
    double excess = 0;
    for (const auto hu : volume->values)
      if (hu > 55) excess += (hu - 55) * volume->frame.voxel_volume_m3();
    const auto ball_of = [](double r) { return 4.0 / 3 * M_PI * r * r * r; };
    const double core = ball_of(kRadius_m - options.cortical_m);
    const double expected = core * (350 - 55) + (ball_of(kRadius_m) - core) * (1500 - 55);
    EXPECT_NEAR(excess / expected, 1, 0.02) << slice_m;
  }
}

TEST(VirtualScan, NoiseHasItsDeviationAndItsSeed) {
  ScanOptions options = quiet();
  const auto clean = scan(options);
  options.noise_hu = 30;
  const auto noisy = scan(options), again = scan(options);
  options.seed = 2;
  const auto other = scan(options);
  ASSERT_TRUE(clean && noisy && again && other);
  EXPECT_EQ(noisy->values, again->values);
  EXPECT_NE(noisy->values, other->values);
  double square = 0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < clean->values.size(); ++n) {
    if (clean->values[n] < -900) continue;  // cut at -1024
    square += std::pow(noisy->values[n] - clean->values[n], 2);
    ++count;
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(count)), 30, 1);
}

TEST(VirtualScan, RefusesWhatItCannotDo) {
  const auto tissues = *load_default_tissues();
  EXPECT_FALSE(virtual_scan({}, tissues, {}));
  ScanOptions options;
  options.spacing_m = 0;
  EXPECT_FALSE(scan(options));
  options.spacing_m = std::nan("");
  EXPECT_FALSE(scan(options));
  const ScannedBone bone{&ball(), {}};
  EXPECT_FALSE(virtual_scan(std::span(&bone, 1), TissueTable{}, {}));
  options = quiet();
  options.progress = [](const char*, double share) { return share < 0.5; };
  EXPECT_FALSE(scan(options));
}

}  // namespace
}  // namespace osteon
