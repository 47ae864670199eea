// The closed form of the view, worked out here anew with matrices of its own.
#include "osteon/render/scope_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace osteon {
namespace {

constexpr double kScopeDegree = std::numbers::pi / 180;
const Viewport kScopePicture{0, 0, 720, 720};
constexpr double kScopeRadius_px = 0.48 * 720;

ScopeDef scope(double angle_deg, double barrel = 0.6) {
  ScopeDef def;
  def.angle_rad = angle_deg * kScopeDegree;
  def.field_rad = 105 * kScopeDegree;
  def.barrel = barrel;
  return def;
}

/// Tip at the origin, shaft towards -z of World, y up.
ScopePose straight(double post_deg) {
  ScopePose pose;
  pose.post_rad = post_deg * kScopeDegree;
  return pose;
}

TEST(ScopeCamera, WithoutAnAngleTheMiddleIsWhereTheShaftPoints) {
  for (const double post : {0.0, 90.0, 200.0}) {
    const auto at = ScopeCamera(scope(0), straight(post)).project(kScopePicture, Vec3(0, 0, -0.02));
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->x, 360, 1e-9);
    EXPECT_NEAR(at->y, 360, 1e-9);
    EXPECT_NEAR(at->depth_m, 0.02, 1e-12);
  }
}

/// By hand: 30 degrees off the shaft, upwards at post 0, to the right at 90, down at 180.
TEST(ScopeCamera, ThePostTurnsTheViewAboutTheShaft) {
  const double s = std::sin(30 * kScopeDegree), c = std::cos(30 * kScopeDegree);
  const struct {
    double post_deg;
    Vec3 middle;
  } cases[] = {{0, {0, s, -c}}, {90, {s, 0, -c}}, {180, {0, -s, -c}}, {270, {-s, 0, -c}}};
  for (const auto& [post, middle] : cases) {
    const auto at = ScopeCamera(scope(30), straight(post)).project(kScopePicture, 0.02 * middle);
    ASSERT_TRUE(at) << post;
    EXPECT_NEAR(at->x, 360, 1e-6) << post;
    EXPECT_NEAR(at->y, 360, 1e-6) << post;
  }
}

/// The head's right and up stay those of the picture: what lies across the tip of the view does
/// not turn, whatever the post does.
TEST(ScopeCamera, TheHorizonStays) {
  for (const double post : {0.0, 40.0, 90.0, 135.0, 300.0}) {
    const ScopeCamera camera(scope(30), straight(post));
    const Mat3 R_WC = camera.X_WC().q.toRotationMatrix();
    // The least turn from the shaft's frame to the view's has its axis across the shaft.
    const Eigen::AngleAxisd turn(R_WC);
    EXPECT_NEAR(turn.axis().z(), 0, 1e-9) << post;
    EXPECT_NEAR(std::abs(turn.angle()), 30 * kScopeDegree, 1e-9) << post;
  }
}

TEST(ScopeCamera, BarrelIsItsClosedForm) {
  const double half = std::asin(std::sin(52.5 * kScopeDegree) / 1.333);
  for (const double barrel : {1.0, 0.6, 0.01})
    for (const double off_deg : {1.0, 10.0, 25.0, 36.0}) {
      const double a = off_deg * kScopeDegree;
      const ScopeCamera camera(scope(0, barrel), straight(0));
      const auto at = camera.project(kScopePicture, 0.03 * Vec3(std::sin(a), 0, -std::cos(a)));
      ASSERT_TRUE(at);
      EXPECT_NEAR(at->x - 360, kScopeRadius_px * std::tan(barrel * a) / std::tan(barrel * half),
                  1e-6);
      EXPECT_NEAR(at->y, 360, 1e-9);
    }
}

TEST(ScopeCamera, WhatLiesOutsideTheFieldIsNotSeen) {
  const ScopeCamera camera(scope(0), straight(0));
  const double out = camera.half_field_rad() + 0.001;
  EXPECT_FALSE(camera.project(kScopePicture, 0.02 * Vec3(std::sin(out), 0, -std::cos(out))));
  EXPECT_FALSE(camera.project(kScopePicture, Vec3(0, 0, 0.02)));
  EXPECT_FALSE(camera.project(kScopePicture, Vec3::Zero()));
  EXPECT_FALSE(camera.project(kScopePicture, Vec3(0, std::numeric_limits<double>::quiet_NaN(), 0)));
  EXPECT_FALSE(camera.ray_through(kScopePicture, 2, 2));
}

TEST(ScopeCamera, ARayGoesThroughWhatItsPixelShows) {
  ScopePose pose;
  pose.at_W = Vec3(0.01, -0.02, 0.03);
  pose.toward_W = Vec3(0.05, 0.01, 0.01);
  pose.up_W = Vec3(0.2, 0.1, 1);
  pose.post_rad = 1.1;
  const ScopeCamera camera(scope(70), pose);
  for (const double x : {100.5, 360.0, 500.5})
    for (const double y : {200.5, 360.0, 560.5}) {
      const auto ray = camera.ray_through(kScopePicture, x, y);
      ASSERT_TRUE(ray);
      EXPECT_NEAR(ray->dir_W.norm(), 1, 1e-12);
      const auto back = camera.project(kScopePicture, ray->origin_W + 0.015 * ray->dir_W);
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->x, x, 1e-6);
      EXPECT_NEAR(back->y, y, 1e-6);
    }
}

TEST(ScopeCamera, ADirectionThatIsNoneIsReplaced) {
  ScopePose pose;
  pose.toward_W = pose.at_W;
  pose.up_W = Vec3::Zero();
  EXPECT_TRUE(is_finite(ScopeCamera(scope(30), pose).X_WC()));
  pose.toward_W = Vec3(0, 1, 0);
  pose.up_W = Vec3(0, 1, 0);
  EXPECT_TRUE(is_finite(ScopeCamera(scope(30), pose).X_WC()));
}

}  // namespace
}  // namespace osteon
