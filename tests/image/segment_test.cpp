#include "osteon/image/segment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "image/dice.h"
#include "osteon/base/random.h"
#include "osteon/image/components.h"
#include "osteon/image/distance_map.h"
#include "osteon/image/fill.h"
#include "osteon/image/threshold.h"
#include "volumes.h"

namespace osteon {
namespace {

GridFrame grid(int i, int j, int k, const Vec3& spacing_m = Vec3::Constant(0.0005)) {
  GridFrame frame;
  frame.size = {i, j, k};
  frame.spacing_m = spacing_m;
  return frame;
}

/// Voxels whose centre lies where `inside` is true.
template <class F>
Mask mask_where(const GridFrame& frame, F inside) {
  Mask mask{frame, {}};
  for (int k = 0; k < frame.size[2]; ++k)
    for (int j = 0; j < frame.size[1]; ++j)
      for (int i = 0; i < frame.size[0]; ++i)
        mask.values.push_back(inside(frame.point_P(Vec3(i, j, k))) ? 1 : 0);
  return mask;
}

Mask random_mask(const GridFrame& frame, std::uint64_t seed, double share) {
  Random random(seed);
  return mask_where(frame, [&](const Vec3&) { return random.uniform() < share; });
}

/// Flood fill, one voxel after the other.
std::vector<int> flood_parts(const Mask& mask) {
  std::vector<int> part(mask.values.size(), 0);
  int count = 0;
  for (std::size_t start = 0; start < part.size(); ++start) {
    if (!mask.values[start] || part[start]) continue;
    ++count;
    std::vector<std::size_t> open = {start};
    part[start] = count;
    while (!open.empty()) {
      const std::size_t n = open.back();
      open.pop_back();
      const int w = mask.frame.size[0], h = mask.frame.size[1];
      const int i = static_cast<int>(n) % w, j = static_cast<int>(n) / w % h,
                k = static_cast<int>(n) / (w * h);
      const int d[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
      for (const auto& s : d) {
        if (!mask.frame.contains(i + s[0], j + s[1], k + s[2])) continue;
        const std::size_t m = mask.frame.index(i + s[0], j + s[1], k + s[2]);
        if (mask.values[m] && !part[m]) {
          part[m] = count;
          open.push_back(m);
        }
      }
    }
  }
  return part;
}

TEST(Components, AgreeWithFloodFillOnRandomMasks) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mask mask = random_mask(grid(11, 9, 7), seed, 0.35);
    LabelVolume labels;
    const auto components = label_components(mask, 1, labels);
    const std::vector<int> part = flood_parts(mask);
    EXPECT_EQ(static_cast<int>(components.size()), *std::max_element(part.begin(), part.end()));
    std::map<int, int> label_of;
    for (std::size_t n = 0; n < part.size(); ++n) {
      ASSERT_EQ(part[n] == 0, labels.values[n] == 0);
      if (part[n]) {
        const auto [known, fresh] = label_of.emplace(part[n], labels.values[n]);
        ASSERT_EQ(known->second, labels.values[n]) << fresh;
      }
    }
    for (std::size_t c = 1; c < components.size(); ++c)
      EXPECT_GE(components[c - 1].voxels, components[c].voxels);
  }
}

TEST(Components, EmptyMasksAndSmallPiecesGiveNone) {
  LabelVolume labels;
  EXPECT_TRUE(
      label_components(mask_where(grid(4, 4, 4), [](const Vec3&) { return false; }), 1, labels)
          .empty());
  EXPECT_TRUE(label_components(random_mask(grid(6, 6, 6), 3, 0.1), 20, labels).empty());
  for (const auto l : labels.values) EXPECT_EQ(l, 0);
}

TEST(Fill, ClosedShellsAreFilledOpenOnesAreNot) {
  const Vec3 middle = Vec3::Constant(0.005);
  const auto shell = [&](const Vec3& p) {
    const double r = (p - middle).norm();
    return r > 0.003 && r < 0.004;
  };
  Mask closed = mask_where(grid(21, 21, 21), shell);
  Mask open = mask_where(grid(21, 21, 21), [&](const Vec3& p) {
    return shell(p) && !(p.z() > middle.z() && (p - middle).head<2>().norm() < 0.0008);
  });
  const Mask open_before = open;
  fill_holes(closed);
  fill_holes(open);
  EXPECT_EQ(closed.at(10, 10, 10), 1);
  EXPECT_EQ(closed.at(0, 0, 0), 0);
  EXPECT_EQ(open.values, open_before.values);
}

// A tube that leaves the grid at both ends is a cut shaft: its marrow is filled.
TEST(Fill, AShaftThatTheScanCutsIsFilled) {
  Mask tube = mask_where(grid(21, 21, 9), [](const Vec3& p) {
    const double r = (p - Vec3::Constant(0.005)).head<2>().norm();
    return r > 0.003 && r < 0.004;
  });
  fill_holes(tube);
  for (int k = 0; k < 9; ++k) EXPECT_EQ(tube.at(10, 10, k), 1);
  EXPECT_EQ(tube.at(0, 0, 4), 0);
}

TEST(DistanceMap, AgreesWithTryingEveryVoxel) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const GridFrame frame = grid(9, 8, 7, Vec3(0.0004, 0.0007, 0.0015));
    const Mask mask = random_mask(frame, seed, 0.9);
    const Grid<float> map = distance_map(mask);
    for (std::size_t n = 0; n < mask.values.size(); ++n) {
      double best = 1e9;
      const auto at = [&](std::size_t m) {
        const int i = static_cast<int>(m) % 9, j = static_cast<int>(m) / 9 % 8,
                  k = static_cast<int>(m) / 72;
        return frame.point_P(Vec3(i, j, k));
      };
      for (std::size_t m = 0; m < mask.values.size(); ++m)
        if (!mask.values[m]) best = std::min(best, (at(n) - at(m)).norm());
      ASSERT_NEAR(map.values[n], best, 1e-7) << seed << " " << n;
    }
  }
}

bool in_ball(const Vec3& p, const Vec3& c, double r) { return (p - c).norm() < r; }

TEST(Watershed, BallsThatTouchArePartedAtTheNeck) {
  const Vec3 a(0.007, 0.007, 0.007), b(0.0183, 0.007, 0.007);
  const Mask mask = mask_where(grid(51, 29, 29), [&](const Vec3& p) {
    return in_ball(p, a, 0.006) || in_ball(p, b, 0.0055);
  });
  LabelVolume labels;
  EXPECT_EQ(split_at_necks(distance_map(mask), {}, labels), 2);
  EXPECT_NE(labels.at(14, 14, 14), labels.at(36, 14, 14));
  for (int i = 0; i < 51; ++i) {
    const double x = i * 0.0005;
    if (x > 0.0015 && x < 0.0115) {
      EXPECT_EQ(labels.at(i, 14, 14), labels.at(14, 14, 14)) << x;
    }
    if (x > 0.0140 && x < 0.0232) {
      EXPECT_EQ(labels.at(i, 14, 14), labels.at(36, 14, 14)) << x;
    }
  }
}

// A metacarpal: thick ends, a shaft of 0.55 of their radius.
TEST(Watershed, ALongBoneStaysOne) {
  const Mask mask = mask_where(grid(101, 29, 29), [](const Vec3& p) {
    const Vec3 axis(p.x(), 0.007, 0.007);
    const bool shaft = (p - axis).norm() < 0.0033 && p.x() > 0.006 && p.x() < 0.044;
    return shaft || in_ball(p, Vec3(0.007, 0.007, 0.007), 0.006) ||
           in_ball(p, Vec3(0.043, 0.007, 0.007), 0.006);
  });
  LabelVolume labels;
  EXPECT_EQ(split_at_necks(distance_map(mask), {}, labels), 1);
}

TEST(Watershed, SeedsMeetInTheDarkestPlane) {
  Volume height{grid(9, 3, 3), {}};
  for (std::size_t n = 0; n < height.frame.count(); ++n) {
    const int i = static_cast<int>(n % 9);
    height.values.push_back(static_cast<std::int16_t>(i == 6 ? 100 : 1000));
  }
  const Mask all = mask_where(height.frame, [](const Vec3&) { return true; });
  LabelVolume seeds{height.frame, std::vector<std::uint16_t>(height.frame.count(), 0)};
  seeds.at(0, 1, 1) = 1;
  seeds.at(8, 1, 1) = 2;
  grow_seeds(height, all, seeds);
  for (int i = 0; i < 9; ++i)
    if (i != 6) {
      EXPECT_EQ(seeds.at(i, 0, 2), i < 6 ? 1 : 2) << i;
    }
  EXPECT_NE(seeds.at(6, 0, 0), 0);
}

/// Two shells with marrow, half a voxel of gap in between, in soft tissue.
Volume two_bones() {
  Volume volume{grid(60, 32, 32), {}};
  Random random(4);
  const Vec3 a(0.0075, 0.008, 0.008), b(0.0205, 0.008, 0.008);
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 60; ++i) {
        const Vec3 p = volume.frame.point_P(Vec3(i, j, k));
        const double d = std::min((p - a).norm() - 0.0065, (p - b).norm() - 0.0063);
        const double hu = d > 0 ? 50 : d > -0.0012 ? 1400 : 300;
        volume.values.push_back(static_cast<std::int16_t>(std::lround(random.normal(hu, 20))));
      }
  return volume;
}

TEST(Threshold, LiesBetweenSoftTissueAndCorticalBone) {
  const BoneLevels levels = find_bone_levels(two_bones());
  EXPECT_NEAR(levels.soft_hu, 50, 15);
  EXPECT_GT(levels.threshold_hu, 250);
  EXPECT_LT(levels.threshold_hu, 900);
  EXPECT_GT(levels.bone_hu, 1200);
}

// A third of muscle in much fat is still what bone stands in; without any, it is the fat.
TEST(Threshold, FatIsTakenForSoftTissueOnlyWhereThereIsNoMuscle) {
  for (const double muscle : {0.3, 0.0}) {
    Volume volume = two_bones();
    Random random(5);
    for (std::int16_t& hu : volume.values) {
      const bool fat = hu < 150 && random.uniform(0, 1) >= muscle;
      if (fat) hu = static_cast<std::int16_t>(std::lround(random.normal(-100, 30)));
    }
    const BoneLevels levels = find_bone_levels(volume);
    EXPECT_NEAR(levels.soft_hu, muscle > 0 ? 50 : -100, 15);
    EXPECT_GT(levels.threshold_hu, 250);
    EXPECT_LT(levels.threshold_hu, 900);
  }
}

TEST(Segment, FindsTwoBonesWithTheirMarrow) {
  SegmentOptions options;
  options.threshold_hu = 600;
  const auto found = segment_bone(two_bones(), options);
  ASSERT_TRUE(found) << found.error().message();
  ASSERT_EQ(found->regions.size(), 2u);
  const double voxel = found->labels.frame.voxel_volume_m3();
  const double ball = 4.0 / 3 * M_PI * std::pow(0.0065, 3);
  EXPECT_NEAR(static_cast<double>(found->regions[0].voxels) * voxel / ball, 1, 0.06);
  EXPECT_NE(found->labels.at(15, 16, 16), 0);
  EXPECT_NE(found->labels.at(15, 16, 16), found->labels.at(41, 16, 16));
  for (const Vec3& p : boundary_points_P(*found, found->regions[0], 100))
    EXPECT_NEAR((p - Vec3(0.0075, 0.008, 0.008)).norm(), 0.0065, 0.0009);
}

// Beyond i = 60 is air with a bar of 6 mm in it.
Volume two_bones_and_a_bar() {
  const Volume bones = two_bones();
  Volume volume{grid(100, 32, 32), {}};
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 100; ++i)
        volume.values.push_back(i < 60              ? bones.at(i, j, k)
                                : i >= 74 && i < 86 ? std::int16_t{1000}
                                                    : std::int16_t{-1000});
  return volume;
}

TEST(Segment, WhatLiesOutsideTheBodyIsNoBoneUnlessWanted) {
  SegmentOptions options;
  options.threshold_hu = 600;
  const auto found = segment_bone(two_bones_and_a_bar(), options);
  ASSERT_TRUE(found) << found.error().message();
  EXPECT_EQ(found->regions.size(), 2u);
  EXPECT_EQ(found->outside, 1u);
  EXPECT_EQ(found->labels.at(80, 16, 16), 0);
  options.outside = true;
  const auto all = segment_bone(two_bones_and_a_bar(), options);
  ASSERT_TRUE(all) << all.error().message();
  EXPECT_EQ(all->regions.size(), 3u);
  EXPECT_EQ(all->outside, 0u);
  EXPECT_NE(all->labels.at(80, 16, 16), 0);
}

TEST(Segment, NothingAboveTheThresholdAndStopsAreSaid) {
  SegmentOptions options;
  options.threshold_hu = 5000;
  const auto none = segment_bone(two_bones(), options);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message().find("5000 HU"), std::string::npos);
  options.threshold_hu = 600;
  options.progress = [](const char*, double share) { return share < 0.2; };
  EXPECT_FALSE(segment_bone(two_bones(), options));
}

TEST(Segment, DiceOfKnownMasks) {
  const GridFrame frame = grid(4, 1, 1);
  const Mask a{frame, {1, 1, 0, 0}}, b{frame, {0, 1, 1, 1}}, none{frame, {0, 0, 0, 0}};
  EXPECT_DOUBLE_EQ(dice(a, a), 1);
  EXPECT_DOUBLE_EQ(dice(a, b), 0.4);
  EXPECT_DOUBLE_EQ(dice(a, none), 0);
  EXPECT_DOUBLE_EQ(dice(none, none), 1);
}

}  // namespace
}  // namespace osteon
