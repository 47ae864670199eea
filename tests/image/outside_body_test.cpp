#include "osteon/image/outside_body.h"

#include <gtest/gtest.h>

#include <cmath>

namespace osteon {
namespace {

constexpr double kAir = -1000, kMuscle = 50, kHard = 900;

/// Parts above 500 HU of a scan of 64 x 64 x 24 voxels whose value follows from the place, mm.
template <class F>
std::vector<bool> outside_of(double voxel_mm, F hu) {
  Volume volume;
  volume.frame.size = {64, 64, 24};
  volume.frame.spacing_m = Vec3::Constant(0.001 * voxel_mm);
  Mask mask{volume.frame, {}};
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i) {
        volume.values.push_back(static_cast<std::int16_t>(
            hu(voxel_mm * (i - 31.5), voxel_mm * (j - 31.5), voxel_mm * (k - 11.5))));
        mask.values.push_back(volume.values.back() > 500 ? 1 : 0);
      }
  LabelVolume labels;
  const std::vector<Component> parts = label_components(mask, 1, labels);
  return parts_outside_body(volume, labels, parts);
}

using Outside = std::vector<bool>;

TEST(OutsideBody, WithoutPartsThereIsNothingAndAScanFullOfBoneIsBone) {
  EXPECT_EQ(outside_of(1, [](double, double, double) { return kAir; }), Outside{});
  EXPECT_EQ(outside_of(1, [](double, double, double) { return kHard; }), Outside{false});
}

TEST(OutsideBody, DryBonesAreBones) {
  const auto two = [](double x, double y, double z) {
    return std::hypot(std::abs(x) - 15, y, z) < 8 ? kHard : kAir;
  };
  EXPECT_EQ(outside_of(1, two), (Outside{false, false}));
}

// A limb along z, 20 mm in radius, with a shaft in it; the larger part comes first.
double limb(double x, double y) {
  const double r = std::hypot(x, y);
  return r < 7 ? kHard : r < 20 ? kMuscle : kAir;
}

TEST(OutsideBody, ARestInAirIsOutsideAndSoIsOneThatTheSkinLiesOn) {
  for (const double gap_mm : {0., 1., 4.}) {
    const auto scan = [&](double x, double y, double) {
      const double below = y - 20 - gap_mm;
      return below > 0 && below < 4 ? kHard : limb(x, y);
    };
    EXPECT_EQ(outside_of(1, scan), (Outside{true, false})) << gap_mm;
  }
}

TEST(OutsideBody, ACastAroundTheLimbIsOutside) {
  const auto scan = [](double x, double y, double) {
    const double r = std::hypot(x, y);
    return r > 20 && r < 25 ? kHard : limb(x, y);
  };
  EXPECT_EQ(outside_of(1, scan), (Outside{true, false}));
}

// As a rib beside the lung, or the shin's edge under skin.
TEST(OutsideBody, BoneUnderTwoMillimetresOfSkinIsBone) {
  const auto scan = [](double x, double y, double) {
    if (y > 6) return kAir;
    return y > -4 && y < 4 && std::abs(x) < 20 ? kHard : kMuscle;
  };
  EXPECT_EQ(outside_of(1, scan), Outside{false});
}

TEST(OutsideBody, CoarseVoxelsTellTheSame) {
  const auto scan = [](double x, double y, double) {
    return y > 35 && y < 45 ? kHard : limb(x, y);
  };
  EXPECT_EQ(outside_of(2.5, scan), (Outside{true, false}));
}

}  // namespace
}  // namespace osteon
