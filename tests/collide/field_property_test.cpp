// What must hold of the contact with any distance field, on random poses. Closed forms of balls and
// the distance to the mesh itself are the judges.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "collide/shapes.h"
#include "mesh/shapes.h"
#include "osteon/collide/field_contact.h"
#include "osteon/mesh/distance.h"

namespace osteon {
namespace {

DistanceField fine_field_of(const TriMesh& mesh) {
  return std::move(DistanceField::make(mesh).value());
}

const TriMesh& egg() {
  static const TriMesh mesh = to_mesh(shapes::ellipsoid(3, {0.004, 0.005, 0.006}));
  return mesh;
}

const DistanceField& egg_field() {
  static const DistanceField field = fine_field_of(egg());
  return field;
}

// A rod, or a ball, that touches the egg or nearly so.
Capsule near_egg(Random& random) {
  const Vec3 out = random.direction();
  const Vec3 p = out.cwiseProduct(Vec3(0.0045, 0.0055, 0.0065));
  const Vec3 way = random.direction();
  const double length = random.next() % 2 == 0 ? 0 : random.uniform(0.0005, 0.003);
  const double radius = random.uniform(0.0002, 0.001);
  return {p, p + length * way, radius};
}

Capsule moved(const Pose& X, const Capsule& c) { return {X * c.p0, X * c.p1, c.radius}; }

TEST(FieldProperty, MovingBoneAndToolTogetherChangesNothing) {
  Random random(81);
  for (int i = 0; i < 2000; ++i) {
    const Capsule rod = near_egg(random);
    const Pose X_WB = shapes::random_pose(random, 2.0);
    const CapsuleContact still = field_contact(egg_field(), rod);
    const Capsule rod_W = moved(X_WB, rod);
    const CapsuleContact back = field_contact(egg_field(), moved(X_WB.inverse(), rod_W));
    ASSERT_EQ(still.status, LpStatus::kOptimal);
    ASSERT_EQ(back.status, LpStatus::kOptimal);
    EXPECT_NEAR(back.gap, still.gap, 1e-9);
    EXPECT_LT((back.p_A - still.p_A).norm(), 1e-6);
  }
}

// The grid goes with the mesh: what is left is the rounding of its heights.
TEST(FieldProperty, AFieldMadeElsewhereInTheFrameIsTheSame) {
  Random random(82);
  for (int k = 0; k < 2; ++k) {
    const Vec3 shift = 0.02 * random.direction();
    TriMesh elsewhere = egg();
    for (Vec3& v : elsewhere.vertices) v += shift;
    const DistanceField field = fine_field_of(elsewhere);
    for (int i = 0; i < 500; ++i) {
      const Capsule rod = near_egg(random);
      const CapsuleContact here = field_contact(egg_field(), rod);
      const CapsuleContact there = field_contact(field, moved({shift, Quat::Identity()}, rod));
      EXPECT_NEAR(there.gap, here.gap, 1.01 * field.data().step_m);
    }
  }
}

// Of two balls each may be the field and the other the tip.
TEST(FieldProperty, SwappingTheBodiesTurnsTheNormal) {
  constexpr double kA = 0.0012, kB = 0.0009;
  const DistanceField a = fine_field_of(test::sphere(kA, 24));
  const DistanceField b = fine_field_of(test::sphere(kB, 24));
  Random random(83);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 dir = random.direction();
    const double gap = random.uniform(-0.0004, 0.0001);
    const Vec3 p_AB = (kA + kB + gap) * dir;
    const CapsuleContact on_a = field_contact(a, {p_AB, p_AB, kB});
    const CapsuleContact on_b = field_contact(b, {-p_AB, -p_AB, kA});
    ASSERT_EQ(on_a.status, LpStatus::kOptimal);
    ASSERT_EQ(on_b.status, LpStatus::kOptimal);
    EXPECT_NEAR(on_a.gap, gap, 8e-6);  // of which the meshes lack 3 at most
    EXPECT_NEAR(on_b.gap, on_a.gap, 8e-6);
    EXPECT_LT((on_a.nhat_AB_A + on_b.nhat_AB_A).norm(), 0.05);
  }
}

TEST(FieldProperty, ARodHasNoFirstEnd) {
  Random random(84);
  for (int i = 0; i < 2000; ++i) {
    const Capsule rod = near_egg(random);
    const CapsuleContact c = field_contact(egg_field(), rod);
    const CapsuleContact d = field_contact(egg_field(), {rod.p1, rod.p0, rod.radius});
    EXPECT_NEAR(d.gap, c.gap, 1e-7);  // to which the search knows it
  }
}

// Lowest height of the axis over the mesh, looked for in many places.
double lowest_over(const MeshDistance& mesh, const Capsule& c) {
  const int count = c.p0 == c.p1 ? 0 : 40;
  double least = 1e300;
  for (int k = 0; k <= count; ++k) {
    const double s = count ? static_cast<double>(k) / count : 0;
    least = std::min(least, mesh.closest(c.p0 + s * (c.p1 - c.p0)).signed_distance);
  }
  return least;
}

// The distance to a convex bone is convex: on any way to its middle the gap falls, step by step.
TEST(FieldProperty, PushingInDeepensMonotonically) {
  const MeshDistance truth(egg());
  constexpr double kStep = 1e-5;
  Random random(85);
  int steps = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 way = -random.direction();
    const Vec3 axis = i % 2 == 0 ? Vec3(Vec3::Zero()) : Vec3(0.002 * random.direction());
    double last = 1e300;
    for (double s = 0.010; s > 0; s -= kStep) {
      const Vec3 p = -s * way;
      const Capsule rod{p - 0.5 * axis, p + 0.5 * axis, 0.0005};
      const CapsuleContact c = field_contact(egg_field(), rod);
      ASSERT_EQ(c.status, LpStatus::kOptimal);
      const double height = c.gap + rod.radius;
      if (height < -0.0004) break;
      if (height > 0.001) continue;  // the band's edge: bounds only
      ++steps;
      ASSERT_LT(c.gap, last - 0.2 * kStep) << i << " " << s;
      last = c.gap;
      if (steps % 50 == 0) {
        EXPECT_NEAR(height, lowest_over(truth, rod), 2e-5);
      }
    }
    EXPECT_LT(last, -0.0008);
  }
  EXPECT_GT(steps, 5000);
}

}  // namespace
}  // namespace osteon
