#include "skin/skin_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace osteon {
namespace {

constexpr double kRadOf = std::numbers::pi / 180;

/// Flat, or over a limb along y of that radius; z = 0 in its middle.
SkinPatch patch_over(double limb_m = 0) {
  constexpr double kCell_m = 0.002;
  constexpr int kSide = 21;
  std::vector<double> heights;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const double x = kCell_m * (i - kSide / 2);
      heights.push_back(limb_m > 0 ? std::sqrt(limb_m * limb_m - x * x) - limb_m : 0);
    }
  SkinPatch patch;
  patch.width_m = patch.height_m = 0.040;
  patch.relief = SkinRelief(kCell_m, kSide, std::move(heights));
  return patch;
}

/// 12 x 8 x 2 mm, its lower face at z = `bottom_m` where it is not turned.
RoundBox plate_at(double bottom_m, const Quat& q = Quat::Identity(), double x_m = 0) {
  return round_box(make_box({Vec3(x_m, 0, bottom_m + 0.001), q}, Vec3(0.006, 0.004, 0.001)));
}

Quat about_y(double degrees) { return Quat(Eigen::AngleAxisd(degrees * kRadOf, Vec3::UnitY())); }

double area_m2(const BoxOnSkin& on) { return std::numbers::pi * on.radius_m * on.radius_m; }

TEST(SkinBox, BesideThePatchItIsNotOnIt) {
  EXPECT_FALSE(box_on_skin(patch_over(), plate_at(-0.001, Quat::Identity(), 0.030)));
}

TEST(SkinBox, AboveTheSkinItIsAsFarAsItsFace) {
  const auto on = box_on_skin(patch_over(), plate_at(0.003));
  ASSERT_TRUE(on);
  EXPECT_NEAR(on->deep_m, -0.003, 1e-12);
}

/// The whole face presses, and its middle is where the push acts.
TEST(SkinBox, AFlatFaceOnFlatSkinPressesWithAllOfIt) {
  for (const double deep : {1e-6, 0.001, 0.004}) {
    const auto on = box_on_skin(patch_over(), plate_at(-deep, Quat::Identity(), 0.003));
    ASSERT_TRUE(on);
    EXPECT_NEAR(on->deep_m, deep, 1e-12);
    EXPECT_NEAR(area_m2(*on), 0.012 * 0.008, 1e-12);
    EXPECT_LT((on->p_S - Vec3(0.003, 0, 0)).norm(), 1e-9);
    EXPECT_LT((on->n_S - Vec3::UnitZ()).norm(), 1e-12);
  }
}

/// A face tilted by t rises from where its rounded edge, of radius r, touches it; the edge itself
/// rises on the other side. Both are half as deep as the edge at these ways beside its middle.
TEST(SkinBox, ATiltedFacePressesWithAStripAlongItsEdge) {
  const double r = 0.0005, slack_m = 0.0001;  // what yields at once
  for (const double deep : {0.0005, 0.001, 0.0015})
    for (const double degrees : {8.0, 14.0, 20.0}) {
      const double t = degrees * kRadOf, half = 0.5 * (deep + slack_m);
      // The middle of the rounded edge, seen from the middle of the plate.
      const double edge_m = -0.0055 * std::sin(t) - 0.0005 * std::cos(t);
      const auto on =
          box_on_skin(patch_over(), plate_at(r - deep - edge_m - 0.001, about_y(degrees)));
      ASSERT_TRUE(on);
      EXPECT_NEAR(on->deep_m, deep, 1e-9);
      const double face_m = r * std::sin(t) + (half - r * (1 - std::cos(t))) / std::tan(t);
      const double beside_m = std::sqrt(r * r - std::pow(std::max(0.0, r - half), 2));
      EXPECT_NEAR(area_m2(*on) / (0.008 * (face_m + beside_m)), 1, 0.2) << deep << " " << degrees;
      EXPECT_GT(on->p_S.x(), 0.002) << "at its edge";
      EXPECT_NEAR(on->p_S.y(), 0, 1e-9);
    }
}

TEST(SkinBox, OnItsSideItPressesWithThatFace) {
  const auto on = box_on_skin(patch_over(), plate_at(0.006 - 0.001 - 0.002, about_y(90)));
  ASSERT_TRUE(on);
  EXPECT_NEAR(on->deep_m, 0.002, 1e-9);
  EXPECT_NEAR(area_m2(*on), 0.002 * 0.008, 1e-9);
}

/// A rectangle without thickness but for its rounding is a box as well.
TEST(SkinBox, AThinBladePressesOnItsEdgeWithItsEdge) {
  const RoundBox blade =
      round_box(make_box({Vec3(0, 0, 0.003), Quat::Identity()}, Vec3(0.005, 0.0002, 0.004)));
  EXPECT_EQ(blade.half.y(), 0);
  const auto on = box_on_skin(patch_over(), blade);
  ASSERT_TRUE(on);
  EXPECT_NEAR(on->deep_m, 0.001, 1e-12);
  EXPECT_NEAR(area_m2(*on), 0.010 * 0.0004, 1e-12);
}

/// Over a limb the face's middle is deepest, though every corner is above the skin.
TEST(SkinBox, OverALimbTheMiddleOfAFacePresses) {
  const double limb_m = 0.030, deep = 0.0004;
  const auto on = box_on_skin(patch_over(limb_m), plate_at(-deep));
  ASSERT_TRUE(on);
  EXPECT_NEAR(on->deep_m, deep, 3e-5);
  const double reach_m = std::sqrt(limb_m * deep);  // of Hertz: the skin is half as far down there
  EXPECT_NEAR(area_m2(*on) / (0.008 * 2 * reach_m), 1, 0.25);
  EXPECT_LT(on->p_S.norm(), 1e-4);
}

/// Place, depth and area have no steps as it tilts and slides.
TEST(SkinBox, TiltingAndSlidingItHasNoSteps) {
  const SkinPatch patch = patch_over(0.060);
  std::optional<BoxOnSkin> before;
  for (int n = 0; n <= 4000; ++n) {
    const double s = n / 4000.0;
    const Quat q = about_y(24 * (s - 0.5)) * Quat(Eigen::AngleAxisd(0.1 * s, Vec3::UnitX()));
    const auto on = box_on_skin(patch, plate_at(-0.0025, q, 0.022 * s));
    ASSERT_TRUE(on);
    if (before) {
      EXPECT_LT(std::abs(on->deep_m - before->deep_m), 1.5e-5) << n;
      EXPECT_LT((on->p_S - before->p_S).norm(), 6e-5) << n;
      EXPECT_LT(std::abs(area_m2(*on) - area_m2(*before)), 1.5e-6) << n;
    }
    before = on;
  }
}

/// The place on the core is as deep as the deepest, as the tick reckons it.
TEST(SkinBox, ThePlaceOnItsCoreIsAsDeepAsTheDeepest) {
  const SkinPatch patch = patch_over(0.060);
  for (const double t : {0.0, 3.0, 30.0, 45.0, 90.0}) {
    const RoundBox box = plate_at(-0.002, about_y(t));
    const auto on = box_on_skin(patch, box);
    ASSERT_TRUE(on);
    const Vec3 core_S = box.X * on->core;
    EXPECT_NEAR(box.rod.radius - on->n_S.dot(core_S - on->p_S), on->deep_m, 1e-9) << t;
  }
}

}  // namespace
}  // namespace osteon
