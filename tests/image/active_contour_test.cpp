#include "osteon/image/active_contour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/dice.h"
#include "osteon/image/segment.h"
#include "volumes.h"

namespace osteon {
namespace {

constexpr int kSide = 64;
constexpr double kMiddle = 31.3, kRadius = 19.6;
constexpr double kSoft = 50, kBone = 1250;

GridFrame contour_frame(int slices) {
  GridFrame frame;
  frame.size = {kSide, kSide, slices};
  frame.spacing_m = Vec3::Constant(0.0005);
  return frame;
}

double from_middle(int i, int j) { return std::hypot(i - kMiddle, j - kMiddle); }

/// A rod along k with an edge about a voxel wide, and noise as a scanner's.
Volume rod(int slices, double noise_hu) {
  Random random(3);
  Volume volume{contour_frame(slices), {}};
  for (int k = 0; k < slices; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const double share = 1 / (1 + std::exp((from_middle(i, j) - kRadius) / 0.4));
        const double hu = kSoft + share * (kBone - kSoft) + noise_hu * random.uniform(-1.7, 1.7);
        volume.values.push_back(static_cast<std::int16_t>(std::lround(hu)));
      }
  return volume;
}

LabelVolume disc_labels(int slices, double radius, double shift, std::uint16_t label = 1) {
  LabelVolume labels{contour_frame(slices),
                     std::vector<std::uint16_t>(contour_frame(slices).count())};
  for (int k = 0; k < slices; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        if (std::hypot(i - kMiddle - shift, j - kMiddle) < radius) labels.at(i, j, k) = label;
  return labels;
}

Mask mask_from(const LabelVolume& labels, std::uint16_t label) {
  Mask mask{labels.frame, {}};
  for (const std::uint16_t v : labels.values) mask.values.push_back(v == label ? 1 : 0);
  return mask;
}

double agreement(const LabelVolume& labels, int slices) {
  return dice(mask_from(labels, 1), mask_from(disc_labels(slices, kRadius, 0), 1));
}

TEST(ActiveContour, RefusesOtherSizesAndOptionsOutOfRange) {
  const Volume volume = rod(2, 0);
  LabelVolume labels = disc_labels(1, kRadius, 0);
  EXPECT_FALSE(refine_contours(volume, labels));
  labels = disc_labels(2, kRadius, 0);
  for (const ContourOptions& bad :
       {ContourOptions{.steps = -1}, ContourOptions{.blur_voxels = -1},
        ContourOptions{.edge_hu = 0},
        ContourOptions{.edge_hu = std::numeric_limits<double>::quiet_NaN()},
        ContourOptions{.smoothing = 99}}) {
    const auto refused = refine_contours(volume, labels, bad);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message().find("out of range"), std::string::npos);
  }
}

TEST(ActiveContour, NothingLabelledStaysNothing) {
  LabelVolume labels = disc_labels(2, 0, 0);
  const auto change = refine_contours(rod(2, 30), labels);
  ASSERT_TRUE(change);
  EXPECT_EQ(change->gained + change->lost, 0u);
  EXPECT_TRUE(measure_regions(labels).empty());
}

TEST(ActiveContour, WithoutEdgesAndSmoothingNothingMoves) {
  Volume flat = rod(1, 0);
  std::fill(flat.values.begin(), flat.values.end(), std::int16_t{700});
  LabelVolume labels = disc_labels(1, 10, 3);
  const LabelVolume before = labels;
  ASSERT_TRUE(refine_contours(flat, labels, {.smoothing = 0}));
  EXPECT_EQ(labels.values, before.values);
}

// Too small, too large and to one side: the true outline is found again, within noise.
TEST(ActiveContour, FindsTheOutlineOfADiscFromAWrongOne) {
  constexpr int kSlices = 3;
  const Volume volume = rod(kSlices, 30);
  const struct {
    double radius, shift;
  } starts[] = {{kRadius - 2.5, 0}, {kRadius + 2.5, 0}, {kRadius, 2}};
  for (const auto& start : starts) {
    LabelVolume labels = disc_labels(kSlices, start.radius, start.shift);
    const double before = agreement(labels, kSlices);
    const auto change = refine_contours(volume, labels);
    ASSERT_TRUE(change);
    EXPECT_LT(before, 0.95);
    EXPECT_GT(agreement(labels, kSlices), 0.985) << start.radius << " " << start.shift;
    EXPECT_GT(change->gained + change->lost, 0u);
    const double area = static_cast<double>(measure_regions(labels)[0].voxels) / kSlices;
    EXPECT_NEAR(area, M_PI * kRadius * kRadius, 0.02 * M_PI * kRadius * kRadius);
  }
}

TEST(ActiveContour, ATrueOutlineStays) {
  const Volume volume = rod(2, 30);
  LabelVolume labels = disc_labels(2, kRadius, 0);
  ASSERT_TRUE(refine_contours(volume, labels));
  EXPECT_GT(agreement(labels, 2), 0.99);
}

TEST(ActiveContour, SpikesAndNotchesAreTakenOff) {
  const Volume volume = rod(1, 0);
  LabelVolume labels = disc_labels(1, kRadius, 0);
  for (int i = 51; i < 58; ++i) labels.at(i, 31, 0) = 1;  // out into the soft tissue
  for (int i = 14; i < 20; ++i) labels.at(i, 31, 0) = 0;  // into the bone
  ASSERT_TRUE(refine_contours(volume, labels));
  EXPECT_EQ(labels.at(56, 31, 0), 0);
  EXPECT_EQ(labels.at(17, 31, 0), 1);
}

TEST(ActiveContour, AnotherLabelsVoxelsAreLeftToIt) {
  const Volume volume = rod(1, 0);
  LabelVolume labels = disc_labels(1, kRadius - 3, 0);
  for (int j = 0; j < kSide; ++j)
    for (int i = 40; i < kSide; ++i)
      if (from_middle(i, j) < kRadius) labels.at(i, j, 0) = 7;
  const Mask other = mask_from(labels, 7);
  ASSERT_TRUE(refine_contours(volume, labels));
  std::size_t taken = 0;
  for (std::size_t n = 0; n < other.values.size(); ++n)
    if (other.values[n] && labels.values[n] == 1) ++taken;
  EXPECT_EQ(taken, 0u);
}

TEST(ActiveContour, ALabelAtTheScansRimAndOneOfOneVoxelAreNoTrouble) {
  const Volume volume = rod(1, 30);
  LabelVolume labels = disc_labels(1, 0, 0);
  labels.at(0, 0, 0) = 1;
  labels.at(kSide - 1, kSide - 1, 0) = 2;
  EXPECT_TRUE(refine_contours(volume, labels));
}

TEST(ActiveContour, StopsOnRequest) {
  LabelVolume labels = disc_labels(1, 10, 0);
  EXPECT_FALSE(refine_contours(rod(1, 0), labels, {}, [](const char*, double) { return false; }));
}

}  // namespace
}  // namespace osteon
