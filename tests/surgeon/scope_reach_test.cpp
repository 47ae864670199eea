#include "osteon/surgeon/scope_reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "osteon/base/random.h"

namespace osteon {
namespace {

constexpr double kRad = std::numbers::pi / 180;

TEST(ScopeReach, PutsThePointInTheMiddleThroughThePortal) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const double x = random.uniform(-0.06, -0.03), y = random.uniform(-0.04, 0.04);
    const double d = random.uniform(0.008, 0.04), turn = random.uniform(-3, 3);
    const double a = random.uniform(0, 70 * kRad);
    const Vec3 portal(x, y, 0.06);
    const Gaze gaze{{0.01, 0.005, 0.01}, d, turn};
    const ScopeOptics optics{a, 0.9};
    const auto pose = pose_for(gaze, portal, optics);
    ASSERT_TRUE(pose);
    const ScopeView view = view_through(optics, *pose);
    EXPECT_NEAR((view.eye_W + d * view.along_W - gaze.at_W).norm(), 0, 1e-9);
    // The portal lies on the shaft, behind the tip.
    const Vec3 back = pose->rotate(Vec3::UnitZ());
    const double along = (portal - pose->p).dot(back);
    EXPECT_GT(along, 0);
    EXPECT_NEAR((portal - pose->p - along * back).norm(), 0, 1e-9);
  }
}

TEST(ScopeReach, IsUprightUnlessItIsTurned) {
  const Vec3 portal(-0.05, -0.02, 0.056);
  const ScopeOptics optics{30 * kRad, 0.9};
  const auto level = pose_for({{0, 0, 0.01}, 0.02, 0}, portal, optics);
  EXPECT_NEAR(turn_deg(view_through(optics, *level)), 0, 1e-9);
  const auto turned = pose_for({{0, 0, 0.01}, 0.02, 40 * kRad}, portal, optics);
  EXPECT_GT(std::abs(turn_deg(view_through(optics, *turned))), 25);
}

TEST(ScopeReach, ThereIsNoneWhereThePortalIsTooNear) {
  EXPECT_FALSE(pose_for({{0, 0, 0}, 0.1, 0}, {0.01, 0, 0.05}, {0.5, 0.9}));
  EXPECT_FALSE(pose_for({{0, 0, 0}, 0.01, 0}, {0, 0, 0.05}, {0.5, 0.9}));  // straight over it
  EXPECT_FALSE(pose_for({{std::nan(""), 0, 0}, 0.01, 0}, {0.05, 0, 0.05}, {0.5, 0.9}));
}

}  // namespace
}  // namespace osteon
