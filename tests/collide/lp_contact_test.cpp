#include "osteon/collide/lp_contact.h"

#include <gtest/gtest.h>

#include "collide/shapes.h"

namespace osteon {
namespace {

using shapes::body;

Pose at(double x, double y, double z) { return {Vec3(x, y, z), Quat::Identity()}; }

void expect_depth(const LpDepth& r, double t, double gap, double tolerance = 1e-12) {
  EXPECT_EQ(r.status, LpStatus::kOptimal);
  EXPECT_NEAR(r.t, t, tolerance);
  EXPECT_NEAR(r.gap, gap, tolerance);
  EXPECT_NEAR(r.nhat_AB_A.norm(), 1, 1e-14);
}

TEST(LpContact, BodyOnItself) {
  for (const Hull& hull :
       {shapes::box({0.01, 0.02, 0.03}), shapes::octahedron({0.01, 0.01, 0.01}),
        shapes::ellipsoid(2, {0.01, 0.02, 0.03}), shapes::cone(12, 0.01, 0.03)}) {
    const ConvexBody b = body(hull);
    EXPECT_TRUE(lp_test(b, b, {}).hit);
    const LpDepth r = lp_depth(b, b, {});
    ASSERT_EQ(r.status, LpStatus::kOptimal);
    EXPECT_LT(r.t, -0.003);
    EXPECT_LT(r.gap, 2 * r.t + 1e-12);
  }
  const ConvexBody cube = body(shapes::box({0.01, 0.02, 0.03}));
  expect_depth(lp_depth(cube, cube, {}), -0.01, -0.02);
}

TEST(LpContact, FacesTouchOverlapAndPart) {
  const ConvexBody a = body(shapes::box({0.01, 0.01, 0.01}));
  const ConvexBody b = body(shapes::box({0.005, 0.005, 0.005}));
  for (const double gap : {-1e-3, -1e-6, 0.0, 1e-6, 1e-3, 1.0}) {
    SCOPED_TRACE(gap);
    const LpDepth r = lp_depth(a, b, at(0.015 + gap, 0.001, 0));
    expect_depth(r, gap / 2, gap);
    EXPECT_NEAR((r.nhat_AB_A - Vec3::UnitX()).norm(), 0, 1e-12);
    EXPECT_EQ(lp_test(a, b, at(0.015 + gap, 0.001, 0)).hit, gap <= 0);
  }
}

TEST(LpContact, EdgesCross) {
  const double s = std::sqrt(0.5);
  const ConvexBody a = body(shapes::box({0.01, 0.01, 0.05}));
  const ConvexBody b = body(shapes::box({0.01, 0.05, 0.01}));
  // Both turned by 45 degrees so that an edge of each faces the other across the x axis.
  const Quat about_z(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()));
  const Quat about_y(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitY()));
  for (const double gap : {-1e-4, -1e-7, 1e-7, 1e-4}) {
    const Pose X_WA{Vec3::Zero(), about_z};
    const Pose X_WB{Vec3(4 * s * 0.01 + gap, 0, 0), about_y};
    const LpDepth r = lp_depth(a, b, X_WA.inverse() * X_WB);
    ASSERT_EQ(r.status, LpStatus::kOptimal);
    EXPECT_NEAR(r.gap, gap, 1e-12);
    EXPECT_NEAR((X_WA.rotate(r.nhat_AB_A) - Vec3::UnitX()).norm(), 0, 1e-9);
    EXPECT_EQ(r.t > 0, gap > 0);
    EXPECT_EQ(lp_test(a, b, X_WA.inverse() * X_WB).hit, gap < 0);
  }
}

TEST(LpContact, TipOnFace) {
  const ConvexBody a = body(shapes::box({0.01, 0.01, 0.01}));
  const ConvexBody tip = body(shapes::cone(16, 0.001, 0.03));
  for (const double gap : {-2e-3, -1e-5, -1e-8, 1e-8, 1e-5}) {
    const LpDepth r = lp_depth(a, tip, at(0.003, -0.002, 0.01 + gap));
    ASSERT_EQ(r.status, LpStatus::kOptimal);
    EXPECT_NEAR(r.gap, gap, 1e-12);
    EXPECT_NEAR((r.nhat_AB_A - Vec3::UnitZ()).norm(), 0, 1e-9);
    EXPECT_EQ(lp_test(a, tip, at(0.003, -0.002, 0.01 + gap)).hit, gap < 0);
  }
}

TEST(LpContact, CornersTouch) {
  const ConvexBody a = body(shapes::octahedron({0.01, 0.01, 0.01}));
  const LpDepth r = lp_depth(a, a, at(0.02, 0, 0));
  expect_depth(r, 0, 0);
  EXPECT_TRUE(lp_test(a, a, at(0.02, 0, 0)).hit);
  EXPECT_TRUE(lp_test(a, a, at(0.02 - 1e-9, 0, 0)).hit);
  EXPECT_FALSE(lp_test(a, a, at(0.02 + 1e-9, 0, 0)).hit);
}

TEST(LpContact, OneDeepInsideTheOther) {
  const ConvexBody a = body(shapes::box({0.05, 0.05, 0.05}));
  const ConvexBody b = body(shapes::octahedron({0.002, 0.002, 0.002}));
  const LpDepth r = lp_depth(a, b, at(0.03, 0.001, -0.002));
  // Out through +x, the nearest face: 20 mm to the face and 2 mm of B.
  expect_depth(r, -0.002 / std::sqrt(3.0), -0.022);
  EXPECT_NEAR((r.nhat_AB_A - Vec3::UnitX()).norm(), 0, 1e-12);
  const LpDepth swapped = lp_depth(b, a, at(0.03, 0.001, -0.002).inverse());
  expect_depth(swapped, r.t, r.gap);
  EXPECT_NEAR((swapped.nhat_AB_A + Vec3::UnitX()).norm(), 0, 1e-12);
}

TEST(LpContact, NeedleThinHulls) {
  const ConvexBody needle = body(shapes::box({1e-6, 1e-6, 0.05}));
  const ConvexBody plate = body(shapes::box({0.05, 0.05, 1e-6}));
  EXPECT_TRUE(lp_test(plate, needle, {}).hit);
  const LpDepth through = lp_depth(plate, needle, {});
  EXPECT_EQ(through.status, LpStatus::kOptimal);
  EXPECT_NEAR(through.t, -1e-6, 1e-12);
  const LpDepth over = lp_depth(plate, needle, at(0.01, 0.01, 0.0501));
  EXPECT_EQ(over.status, LpStatus::kOptimal);
  EXPECT_NEAR(over.gap, 0.0001 - 1e-6, 1e-12);
  EXPECT_FALSE(lp_test(plate, needle, at(0.01, 0.01, 0.0501)).hit);
}

TEST(LpContact, TinyAndHugeAndFarFromTheOrigin) {
  for (const double size : {1e-7, 1e-3, 1.0, 1e4}) {
    const ConvexBody a = body(shapes::box(Vec3::Constant(size)));
    for (const double share : {-0.1, -1e-6, 1e-6, 0.1}) {
      const LpDepth r = lp_depth(a, a, at(0, (2 + share) * size, 0.3 * size));
      expect_depth(r, share * size / 2, share * size, 1e-11 * size);
      EXPECT_EQ(lp_test(a, a, at(0, (2 + share) * size, 0.3 * size)).hit, share < 0);
    }
  }
  const Vec3 far(300, -700, 50);
  const ConvexBody a = body(shapes::box(Vec3::Constant(0.01), far));
  const ConvexBody b = body(shapes::box(Vec3::Constant(0.01), -far));
  const LpDepth r = lp_depth(a, b, {far + far + Vec3(0.0195, 0, 0), Quat::Identity()});
  expect_depth(r, -0.00025, -0.0005, 1e-11);
}

TEST(LpContact, VeryFarApartIsAMiss) {
  const ConvexBody a = body(shapes::box({0.01, 0.01, 0.01}));
  for (const double away : {1e3, 1e9, 1e15, 1e30, 1e100}) {
    const LpHit hit = lp_test(a, a, at(0, -away, 0));
    EXPECT_EQ(hit.status, LpStatus::kUnbounded);
    const LpDepth r = lp_depth(a, a, at(0, -away, 0));
    ASSERT_EQ(r.status, LpStatus::kOptimal);
    EXPECT_NEAR(r.t / away, 0.5, 1e-4);
    EXPECT_GT(r.gap, 0.99 * away);
  }
  EXPECT_FALSE(lp_test(a, a, at(0, -1e308, 1e308)).hit);
}

TEST(LpContact, RefusesPosesThatAreNotFinite) {
  const ConvexBody a = body(shapes::box({1, 1, 1}));
  EXPECT_EQ(lp_depth(a, a, at(NAN, 0, 0)).status, LpStatus::kNumerical);
  EXPECT_EQ(lp_test(a, a, at(0, INFINITY, 0)).status, LpStatus::kNumerical);
  EXPECT_FALSE(lp_test(a, a, at(0, INFINITY, 0)).hit);
}

TEST(LpContact, WarmStartTakesNoPivotAtTheSamePose) {
  const ConvexBody a = body(shapes::ellipsoid(3, {0.01, 0.015, 0.04}));
  const ConvexBody b = body(shapes::ellipsoid(1, {0.002, 0.002, 0.01}));
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    const Pose X_AB = shapes::random_pose(random, 0.04);
    LpBasis depth, test;
    const LpDepth cold = lp_depth(a, b, X_AB, &depth);
    const LpDepth warm = lp_depth(a, b, X_AB, &depth);
    ASSERT_EQ(cold.status, LpStatus::kOptimal);
    EXPECT_EQ(warm.pivots, 0);
    EXPECT_EQ(warm.t, cold.t);
    const LpHit first = lp_test(a, b, X_AB, &test);
    const LpHit second = lp_test(a, b, X_AB, &test);
    EXPECT_EQ(first.hit, cold.t <= 0);
    EXPECT_EQ(second.hit, first.hit);
    EXPECT_LE(second.pivots, 1);
  }
}

TEST(LpContact, ABasisOfAnotherPairDoesNoHarm) {
  const ConvexBody a = body(shapes::ellipsoid(2, {0.01, 0.015, 0.04}));
  const ConvexBody b = body(shapes::box({0.01, 0.01, 0.01}));
  const Pose X_AB = at(0.015, 0.003, 0.002);
  const LpDepth cold = lp_depth(a, b, X_AB);
  for (LpBasis basis :
       {LpBasis{{9999, 1, 2, 3}, 4}, LpBasis{{0, 0, 0, 0}, 4}, LpBasis{{0, 1, 2, 3}, 4},
        LpBasis{{7, 320, 325, 11}, 4}, LpBasis{{5, 6, 7, 0}, 3}}) {
    LpBasis copy = basis;
    const LpDepth r = lp_depth(a, b, X_AB, &copy);
    EXPECT_EQ(r.status, LpStatus::kOptimal);
    EXPECT_NEAR(r.t, cold.t, 1e-12);
    copy = basis;
    EXPECT_TRUE(lp_test(a, b, X_AB, &copy).hit);
  }
}

}  // namespace
}  // namespace osteon
