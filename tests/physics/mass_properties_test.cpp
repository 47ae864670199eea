#include "mass_properties.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "osteon/base/random.h"
#include "physics_fixtures.h"

namespace osteon {
namespace {

using testing::box_hull;

Mat3 inertia_of(const MassProperties& m) {
  const Mat3 axes = m.X_BI.q.toRotationMatrix();
  return axes * m.moments.asDiagonal() * axes.transpose();
}

// m/12 (b^2 + c^2) and so on, with full sizes.
Mat3 box_inertia(double mass, const Vec3& half, const Quat& q) {
  const Vec3 s = half.cwiseProduct(half) * 4;
  const Vec3 moments = mass / 12 * Vec3(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  const Mat3 axes = q.toRotationMatrix();
  return axes * moments.asDiagonal() * axes.transpose();
}

TEST(MassProperties, WithoutHullsIsABall) {
  const MassProperties m = mass_properties({}, 0.01);
  EXPECT_EQ(m.mass_kg, 0.01);
  EXPECT_TRUE((m.moments.array() > 0).all());
}

TEST(MassProperties, OfAFlatHullIsABallThere) {
  const Hull flat = box_hull({1, 2, 3}, {0.01, 0.01, 0});
  const MassProperties m = mass_properties(std::vector<Hull>{flat}, 0.01);
  EXPECT_TRUE((m.moments.array() > 0).all());
  EXPECT_LT((m.X_BI.p - Vec3(1, 2, 3)).norm(), 1e-12);
}

TEST(MassProperties, OfABoxHasAClosedForm) {
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    const Vec3 center = random.direction() * random.uniform(0, 0.5);
    const double x = random.uniform(0.001, 0.03);
    const double y = random.uniform(0.001, 0.03);
    const double z = random.uniform(0.001, 0.03);
    const Quat q = random.rotation();
    const MassProperties m =
        mass_properties(std::vector<Hull>{box_hull(center, {x, y, z}, q)}, 0.004);
    EXPECT_LT((m.X_BI.p - center).norm(), 1e-12);
    const Mat3 expected = box_inertia(0.004, {x, y, z}, q);
    EXPECT_LT((inertia_of(m) - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(MassProperties, OfTwoHalvesAreThoseOfTheWhole) {
  const std::vector<Hull> halves = {box_hull({-0.01, 0, 0}, {0.01, 0.004, 0.006}),
                                    box_hull({0.01, 0, 0}, {0.01, 0.004, 0.006})};
  const MassProperties m = mass_properties(halves, 0.02);
  const Mat3 expected = box_inertia(0.02, {0.02, 0.004, 0.006}, Quat::Identity());
  EXPECT_LT(m.X_BI.p.norm(), 1e-14);
  EXPECT_LT((inertia_of(m) - expected).norm(), 1e-12 * expected.norm());
}

// A box that has lost one half is the other half.
TEST(MassProperties, LessAHalfAreThoseOfTheOther) {
  const Vec3 half(0.01, 0.008, 0.006), middle(0.02, -0.01, 0.03);
  const MassProperties whole = mass_properties(std::vector<Hull>{box_hull(middle, half)}, 0.02);
  EXPECT_EQ(less(whole, BoneLoss{}).moments, whole.moments);
  const Vec3 quarter(0.005, 0.008, 0.006), right = middle + Vec3(0.005, 0, 0);
  BoneLoss loss;
  loss.mass_kg = 0.01;
  loss.first_B = 0.01 * right;
  loss.second_B = 0.01 * right * right.transpose();
  for (int a = 0; a < 3; ++a) loss.second_B(a, a) += 0.01 * quarter[a] * quarter[a] / 3;
  const MassProperties left = less(whole, loss);
  EXPECT_NEAR(left.mass_kg, 0.01, 1e-15);
  EXPECT_LT((left.X_BI.p - (middle - Vec3(0.005, 0, 0))).norm(), 1e-12);
  const Mat3 wanted = box_inertia(0.01, quarter, Quat::Identity());
  EXPECT_LT((inertia_of(left) - wanted).norm(), 1e-9 * wanted.norm());
  // Of a body that has lost all, a little stays.
  loss.mass_kg = 0.02;
  EXPECT_NEAR(less(whole, loss).mass_kg, 0.001, 1e-15);
  EXPECT_GT(less(whole, loss).moments.minCoeff(), 0);
}

TEST(PrincipalAxes, OfADiagonalMatrixAreItsOwn) {
  Vec3 values;
  const Mat3 axes = principal_axes(Vec3(3, 1, 2).asDiagonal(), values);
  EXPECT_EQ(axes, Mat3::Identity());
  EXPECT_EQ(values, Vec3(3, 1, 2));
  EXPECT_EQ(principal_axes(Mat3::Zero(), values), Mat3::Identity());
}

TEST(PrincipalAxes, DiagonaliseAnySymmetricMatrix) {
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    Mat3 a;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c <= r; ++c) a(r, c) = a(c, r) = random.uniform(-1, 1);
    if (i % 4 == 0) a = Vec3(1, 1, 1 + 1e-9 * i).asDiagonal();
    Vec3 values;
    const Mat3 axes = principal_axes(a, values);
    EXPECT_LT((axes * values.asDiagonal() * axes.transpose() - a).norm(), 1e-14);
    EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-14);
    EXPECT_NEAR(axes.determinant(), 1, 1e-14);
  }
}

}  // namespace
}  // namespace osteon
