#include "osteon/base/types.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/base/random.h"

namespace osteon {
namespace {

Pose random_pose(Random& r) {
  Pose X;
  X.q = r.rotation();
  X.p = r.direction();
  return X;
}

TEST(Pose, DefaultIsTheIdentity) { EXPECT_EQ(Pose{} * Vec3(1, 2, 3), Vec3(1, 2, 3)); }

TEST(Pose, InverseUndoes) {
  Random r(1);
  for (int i = 0; i < 100; ++i) {
    const Pose X = random_pose(r);
    const Vec3 p = r.direction();
    EXPECT_LT((X.inverse() * (X * p) - p).norm(), 1e-14);
  }
}

TEST(Pose, CompositionAppliesTheRightOneFirst) {
  Random r(2);
  const Pose X_AB = random_pose(r);
  const Pose X_BC = random_pose(r);
  const Vec3 p_C = r.direction();
  EXPECT_LT(((X_AB * X_BC) * p_C - X_AB * (X_BC * p_C)).norm(), 1e-14);
}

TEST(Aabb, EmptyOverlapsNothing) {
  Aabb unit;
  unit.include(Vec3::Zero());
  unit.include(Vec3::Ones());
  EXPECT_TRUE(Aabb{}.empty());
  EXPECT_FALSE(Aabb{}.overlaps(unit));
  EXPECT_FALSE(unit.overlaps(Aabb{}));
}

TEST(Aabb, TouchingBoxesOverlap) {
  Aabb a, b;
  a.include(Vec3::Zero());
  a.include(Vec3::Ones());
  b.include(Vec3(1, 0, 0));
  b.include(Vec3(2, 1, 1));
  EXPECT_TRUE(a.overlaps(b));
  b.lo.x() = 1.001;
  EXPECT_FALSE(a.overlaps(b));
  EXPECT_TRUE(a.overlaps(b.grown(0.01)));
}

TEST(Finite, RefusesNanAndInfinityInAnyPlace) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    for (int i = 0; i < 3; ++i) {
      Vec3 v = Vec3::Zero();
      v[i] = bad;
      EXPECT_FALSE(is_finite(v));
    }
    Pose X;
    X.q.z() = bad;
    EXPECT_FALSE(is_finite(X));
  }
  EXPECT_TRUE(is_finite(Pose{}));
}

}  // namespace
}  // namespace osteon
