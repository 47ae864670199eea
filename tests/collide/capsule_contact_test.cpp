#include "osteon/collide/capsule_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "collide/shapes.h"
#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

constexpr double kTolerance = 1e-11;

const Vec3 kHalf(0.01, 0.02, 0.03);

ConvexBody box_body() { return make_convex_body(shapes::box(kHalf)); }

Hull random_hull(Random& random) { return shapes::random_hull(random, 40, 0.02 * Vec3::Ones()); }

// Least distance of the axis from the surface: convex along the axis, so thirds find it.
double axis_distance(const MeshDistance& surface, const Capsule& c) {
  const auto at = [&](double s) {
    return surface.closest(c.p0 + s * (c.p1 - c.p0)).signed_distance;
  };
  double lo = 0, hi = 1;
  for (int i = 0; i < 120; ++i) {
    const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
    (at(a) < at(b) ? hi : lo) = at(a) < at(b) ? b : a;
  }
  return std::min({at(0.5 * (lo + hi)), at(0), at(1)});
}

TEST(CapsuleContact, RefusesWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(capsule_contact(box_body(), {Vec3(nan, 0, 0), Vec3::Zero(), 0}).status,
            LpStatus::kOptimal);
  EXPECT_NE(capsule_contact(box_body(), {Vec3::Zero(), Vec3::Zero(), -1}).status,
            LpStatus::kOptimal);
}

TEST(CapsuleContact, BallAtFaceEdgeAndCorner) {
  const ConvexBody box = box_body();
  const Vec3 out(0.003, 0.004, 0.012);
  for (int bits = 1; bits < 8; ++bits) {
    Vec3 p = 0.3 * kHalf, step = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      if (bits >> k & 1) {
        p[k] = kHalf[k] + out[k];
        step[k] = out[k];
      }
    const CapsuleContact c = capsule_contact(box, {p, p, 0.001});
    ASSERT_EQ(c.status, LpStatus::kOptimal);
    EXPECT_NEAR(c.gap, step.norm() - 0.001, kTolerance);
    EXPECT_LT((c.nhat_AB_A - step.normalized()).norm(), 1e-9);
    EXPECT_LT((c.p_A + step - p).norm(), 1e-9);
  }
}

TEST(CapsuleContact, RodAcrossAnEdge) {
  // Over the edge x = half, y = half along z, at right angles to it and at 45 degrees to both
  // faces.
  const Vec3 middle(kHalf.x() + 0.001, kHalf.y() + 0.001, 0.002);
  const Vec3 along = Vec3(1, -1, 0).normalized();
  const CapsuleContact c =
      capsule_contact(box_body(), {middle - 0.02 * along, middle + 0.03 * along, 0.0005});
  EXPECT_NEAR(c.gap, 0.001 * std::sqrt(2.0) - 0.0005, kTolerance);
  EXPECT_LT((c.nhat_AB_A - Vec3(1, 1, 0).normalized()).norm(), 1e-9);
}

TEST(CapsuleContact, PointInsideIsAsDeepAsItsNearestFace) {
  const CapsuleContact c = capsule_contact(box_body(), {{0.008, 0, 0}, {0.008, 0, 0}, 0});
  EXPECT_NEAR(c.gap, -0.002, kTolerance);
  EXPECT_LT((c.nhat_AB_A - Vec3::UnitX()).norm(), 1e-12);
}

TEST(CapsuleContact, RodThroughAnEdgeIsPushedOutSquareToBoth) {
  const Vec3 middle(kHalf.x() - 0.001, kHalf.y() - 0.001, 0.002);
  const Vec3 along = Vec3(1, -1, 0).normalized();
  const CapsuleContact c =
      capsule_contact(box_body(), {middle - 0.02 * along, middle + 0.02 * along, 0.0005});
  ASSERT_EQ(c.status, LpStatus::kOptimal);
  EXPECT_NEAR(c.gap, -0.001 * std::sqrt(2.0) - 0.0005, kTolerance);
  EXPECT_LT((c.nhat_AB_A - Vec3(1, 1, 0).normalized()).norm(), 1e-9);
}

TEST(CapsuleContact, TouchingInEveryWayEnds) {
  const ConvexBody box = box_body();
  for (int bits = 0; bits < 27; ++bits) {
    const Vec3 at(bits % 3 - 1, bits / 3 % 3 - 1, bits / 9 - 1);
    const Vec3 p = at.cwiseProduct(kHalf);
    const CapsuleContact ball = capsule_contact(box, {p, p, 0});
    EXPECT_EQ(ball.status, LpStatus::kOptimal) << bits;
    const double want = bits == 13 ? -kHalf.x() : 0;
    EXPECT_NEAR(ball.gap, want, 1e-10) << bits;
    const CapsuleContact rod = capsule_contact(box, {p, 1.5 * p, 0});
    EXPECT_EQ(rod.status, LpStatus::kOptimal) << bits;
  }
}

TEST(CapsuleContact, DistanceIsThatOfTheSurface) {
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    const Hull hull = random_hull(random);
    const ConvexBody body = make_convex_body(hull);
    const MeshDistance surface(to_mesh(hull));
    for (int k = 0; k < 10; ++k) {
      const Vec3 middle = random.uniform(0.02, 0.05) * random.direction();
      const Vec3 half = random.uniform(0.0, 0.03) * random.direction();
      const Capsule c{middle - half, middle + half, 0.0007};
      const CapsuleContact got = capsule_contact(body, c);
      ASSERT_EQ(got.status, LpStatus::kOptimal);
      const double want = axis_distance(surface, c);
      if (want > 1e-6) {
        ASSERT_NEAR(got.gap + c.radius, want, 1e-9);
        ASSERT_NEAR((got.p_axis_A - got.p_A).norm(), want, 1e-9);
      } else if (want < -1e-6) {
        ASSERT_LT(got.gap, -c.radius);
      }
    }
  }
}

TEST(CapsuleContact, MovingByTheGapBringsThemToTouch) {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const ConvexBody body = make_convex_body(random_hull(random));
    const Vec3 middle = random.uniform(0.0, 0.03) * random.direction();
    const Vec3 half = random.uniform(0.0, 0.02) * random.direction();
    Capsule c{middle - half, middle + half, 0.001};
    const CapsuleContact before = capsule_contact(body, c);
    ASSERT_EQ(before.status, LpStatus::kOptimal);
    const Vec3 move = (1e-6 - before.gap) * before.nhat_AB_A;
    c.p0 += move;
    c.p1 += move;
    const CapsuleContact after = capsule_contact(body, c);
    EXPECT_GE(after.gap, 1e-6 - 1e-10);
    if (before.gap > -c.radius) {
      EXPECT_NEAR(after.gap, 1e-6, 1e-9);
    }
  }
}

TEST(CapsuleContact, TheGapNeverJumpsMoreThanTheCapsuleMoves) {
  Random random(3);
  const ConvexBody body = make_convex_body(random_hull(random));
  // In through one side and out through the other, a micrometre a step, for a ball.
  const Vec3 from = 0.03 * random.direction();
  const Vec3 step = -1e-6 * from.normalized();
  double last = capsule_contact(body, {from, from, 0.0005}).gap;
  for (int i = 1; i < 60000; ++i) {
    const Vec3 p = from + i * step;
    const double gap = capsule_contact(body, {p, p, 0.0005}).gap;
    ASSERT_LE(std::abs(gap - last), 1e-6 + 1e-9) << i;
    last = gap;
  }
}

// Slid, lifted and turned about a body, and with a basis of another body: what a search from the
// start finds, in fewer steps while it slides.
TEST(CapsuleContact, GoingOnFromTheLastSearchFindsTheSame) {
  Random random(4);
  int cold_steps = 0, warm_steps = 0;
  for (int i = 0; i < 30; ++i) {
    const ConvexBody body = make_convex_body(random_hull(random));
    LpBasis basis;
    basis.count = 4;
    basis.rows = {7, 100000, 7, 4000000000u};
    const Vec3 middle = random.uniform(0.015, 0.03) * random.direction();
    const Vec3 half = 0.05 * random.direction();
    const Vec3 step = 1e-5 * random.direction();
    for (int k = 0; k < 300; ++k) {
      const Vec3 jump = k % 100 == 99 ? Vec3(0.02 * random.direction()) : Vec3(k * step);
      const Capsule c{middle - half + jump, middle + half + jump, 0.001};
      const CapsuleContact cold = capsule_contact(body, c);
      const CapsuleContact warm = capsule_contact(body, c, &basis);
      ASSERT_EQ(warm.status, cold.status);
      ASSERT_NEAR(warm.gap, cold.gap, kTolerance);
      if (cold.gap + c.radius > 1e-6) {
        ASSERT_LT((warm.nhat_AB_A - cold.nhat_AB_A).norm(), 1e-6);
      }
      cold_steps += cold.steps;
      warm_steps += warm.steps;
    }
  }
  EXPECT_LT(2 * warm_steps, cold_steps);
}

}  // namespace
}  // namespace osteon
