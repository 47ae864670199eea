#include "osteon/collide/primitive_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "collide/shapes.h"
#include "mesh/shapes.h"

namespace osteon {
namespace {

constexpr double kWithin = 1e-9;

Vec3 random_point(Random& random, double reach) {
  return reach * Vec3(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
}

Primitive random_rod(Random& random) {
  const Vec3 p = random_point(random, 0.02);
  const bool ball = random.uniform() < 0.3;
  return make_rod(p, ball ? p : random_point(random, 0.02), 0.0005 + 0.003 * random.uniform());
}

Primitive random_box(Random& random) {
  const Vec3 half =
      Vec3::Constant(0.001) + 0.008 * Vec3(random.uniform(), random.uniform(), random.uniform());
  return make_box(shapes::random_pose(random, 0.01), half);
}

// Convex in both: thirds within thirds find the least distance of two segments.
double segment_distance(const Capsule& a, const Capsule& b) {
  const auto thirds = [](const auto& f) {
    double lo = 0, hi = 1;
    for (int i = 0; i < 60; ++i) {
      const double x = lo + (hi - lo) / 3, y = hi - (hi - lo) / 3;
      (f(x) < f(y) ? hi : lo) = f(x) < f(y) ? y : x;
    }
    return std::min({f(0.0), f(1.0), f(0.5 * (lo + hi))});
  };
  return thirds([&](double s) {
    const Vec3 p = a.p0 + s * (a.p1 - a.p0);
    return thirds([&](double t) { return (p - b.p0 - t * (b.p1 - b.p0)).norm(); });
  });
}

Primitive moved(const Pose& X, const Primitive& p) {
  return p.kind == Primitive::Kind::kRod ? make_rod(X * p.rod.p0, X * p.rod.p1, p.rod.radius)
                                         : make_box(X * p.X_TB, p.half);
}

// Moving B by -gap along the normal leaves the two touching, and no shorter way in any of many
// directions parts them.
void expect_parts(const Primitive& a, const Primitive& b_A, const PrimitiveContact& contact) {
  const Vec3& n = contact.nhat_AB_A;
  EXPECT_NEAR(n.norm(), 1, 1e-12);
  EXPECT_NEAR(support(a, n), contact.top_A, kWithin);
  EXPECT_NEAR(-support(b_A, -n) - support(a, n), contact.gap, kWithin);
}

TEST(PrimitiveContact, WhatIsNotFiniteIsRefused) {
  const Primitive rod = make_rod(Vec3::Zero(), Vec3::UnitZ(), 0.1);
  const Primitive box = make_box({}, Vec3::Ones());
  Pose bad;
  bad.p.x() = std::numeric_limits<double>::quiet_NaN();
  for (const Primitive* a : {&rod, &box})
    for (const Primitive* b : {&rod, &box})
      EXPECT_NE(primitive_contact(*a, *b, bad).status, LpStatus::kOptimal);
}

TEST(PrimitiveContact, BallsAtOnePlaceAndAxesThatCrossHaveANormal) {
  const Primitive ball = make_rod(Vec3::Zero(), Vec3::Zero(), 0.002);
  const PrimitiveContact same = primitive_contact(ball, ball, {});
  ASSERT_EQ(same.status, LpStatus::kOptimal);
  EXPECT_DOUBLE_EQ(same.gap, -0.004);
  EXPECT_NEAR(same.nhat_AB_A.norm(), 1, 1e-12);
  const Primitive x = make_rod(-Vec3::UnitX(), Vec3::UnitX(), 0.1);
  const Primitive y = make_rod(-Vec3::UnitY(), Vec3::UnitY(), 0.2);
  const PrimitiveContact crossed = primitive_contact(x, y, {});
  EXPECT_NEAR(crossed.gap, -0.3, 1e-15);
  EXPECT_NEAR(std::abs(crossed.nhat_AB_A.z()), 1, 1e-12);
  expect_parts(x, y, crossed);
  // One axis within the other: any way across is the shortest.
  const PrimitiveContact along = primitive_contact(x, x, {});
  EXPECT_NEAR(along.nhat_AB_A.x(), 0, 1e-12);
  expect_parts(x, x, along);
}

TEST(PrimitiveContact, RodsAreAsFarApartAsTheirAxesLessTheirRadii) {
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Primitive a = random_rod(random), b = random_rod(random);
    const Pose X_AB = shapes::random_pose(random, 0.02);
    const Primitive b_A = moved(X_AB, b);
    const PrimitiveContact contact = primitive_contact(a, b, X_AB);
    ASSERT_EQ(contact.status, LpStatus::kOptimal);
    EXPECT_NEAR(contact.gap, segment_distance(a.rod, b_A.rod) - a.rod.radius - b.rod.radius, 1e-8);
    expect_parts(a, b_A, contact);
  }
}

TEST(PrimitiveContact, BallsAreAsFarFromABoxAsTheNearestPointOfIt) {
  Random random(2);
  int outside = 0;
  for (int i = 0; i < 300; ++i) {
    const Primitive box = random_box(random);
    const Vec3 p = random_point(random, 0.03);
    const Primitive ball = make_rod(p, p, 0.001);
    const Vec3 p_B = box.X_TB.inverse() * p;
    const Vec3 nearest = p_B.cwiseMax(-box.half).cwiseMin(box.half);
    const double distance = (p_B - nearest).norm();
    const double inside = (p_B.cwiseAbs() - box.half).maxCoeff();
    const double expected = (distance > 0 ? distance : inside) - 0.001;
    const PrimitiveContact ab = primitive_contact(box, ball, {});
    const PrimitiveContact ba = primitive_contact(ball, box, {});
    ASSERT_EQ(ab.status, LpStatus::kOptimal);
    EXPECT_NEAR(ab.gap, expected, kWithin);
    EXPECT_NEAR(ba.gap, expected, kWithin);
    EXPECT_LT((ab.nhat_AB_A + ba.nhat_AB_A).norm(), 1e-6);
    expect_parts(box, ball, ab);
    expect_parts(ball, box, ba);
    outside += distance > 0;
  }
  EXPECT_GT(outside, 100);
  EXPECT_LT(outside, 300);
}

// Least distance of the edges of either from the other: exact while the boxes are apart.
double edge_distance(const Primitive& a, const Primitive& b_A) {
  double least = std::numeric_limits<double>::infinity();
  const auto edges_of = [&](const Primitive& box, const Primitive& other) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double s : {-1.0, 1.0})
        for (const double t : {-1.0, 1.0}) {
          Vec3 from = box.half;
          from[(axis + 1) % 3] *= s;
          from[(axis + 2) % 3] *= t;
          Vec3 to = from;
          to[axis] = -from[axis];
          const CapsuleContact c = capsule_contact(other.body, {box.X_TB * from, box.X_TB * to, 0});
          least = std::min(least, c.gap);
        }
  };
  edges_of(a, b_A);
  edges_of(b_A, a);
  return least;
}

TEST(PrimitiveContact, BoxesApartAreAsFarAsTheirEdgesAre) {
  Random random(3);
  int apart = 0;
  for (int i = 0; i < 300; ++i) {
    const Primitive a = random_box(random), b = random_box(random);
    const Pose X_AB = shapes::random_pose(random, 0.03);
    const Primitive b_A = moved(X_AB, b);
    const double expected = edge_distance(a, b_A);
    if (!(expected > 1e-6)) continue;
    ++apart;
    const PrimitiveContact contact = primitive_contact(a, b, X_AB);
    ASSERT_EQ(contact.status, LpStatus::kOptimal);
    EXPECT_NEAR(contact.gap, expected, kWithin);
    expect_parts(a, b_A, contact);
  }
  EXPECT_GT(apart, 100);
}

TEST(PrimitiveContact, OverlappingBoxesAreNotPartedByAShorterWay) {
  Random random(4);
  int overlapping = 0;
  for (int i = 0; i < 300; ++i) {
    const Primitive a = random_box(random), b = random_box(random);
    const Pose X_AB = shapes::random_pose(random, 0.004);
    const Primitive b_A = moved(X_AB, b);
    const PrimitiveContact contact = primitive_contact(a, b, X_AB);
    ASSERT_EQ(contact.status, LpStatus::kOptimal);
    expect_parts(a, b_A, contact);
    if (contact.gap >= 0) continue;
    ++overlapping;
    for (int k = 0; k < 200; ++k) {
      const Vec3 n = random.direction();
      EXPECT_LT(-support(b_A, -n) - support(a, n), contact.gap + kWithin);
    }
  }
  EXPECT_GT(overlapping, 150);
}

TEST(PrimitiveContact, RodsAndBoxesMeetPiecesAsTheirBodiesDo) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const ConvexBody piece = make_convex_body(shapes::random_hull(random, 30, 0.01 * Vec3::Ones()));
    const Pose X_AB = shapes::random_pose(random, 0.03);
    const Primitive rod = random_rod(random), box = random_box(random);
    LpBasis basis;
    const PrimitiveContact of_box = primitive_contact(piece, box, X_AB, &basis);
    ASSERT_EQ(of_box.status, LpStatus::kOptimal);
    const Primitive box_A = moved(X_AB, box);
    EXPECT_NEAR(-support(box_A, -of_box.nhat_AB_A) - support(piece, of_box.nhat_AB_A), of_box.gap,
                kWithin);
    const PrimitiveContact of_rod = primitive_contact(piece, rod, X_AB);
    ASSERT_EQ(of_rod.status, LpStatus::kOptimal);
    const Primitive rod_A = moved(X_AB, rod);
    EXPECT_NEAR(support(piece, of_rod.nhat_AB_A), of_rod.top_A, kWithin);
    EXPECT_NEAR(-support(rod_A, -of_rod.nhat_AB_A) - of_rod.top_A, of_rod.gap, kWithin);
  }
}

const DistanceField& round_field() {
  static const DistanceField field = [] {
    FieldOptions options;
    options.cell_m = 0.0005;
    options.outside_m = 0.004;
    return std::move(DistanceField::make(test::sphere(0.008, 60), options).value());
  }();
  return field;
}

TEST(PrimitiveContact, ABoxOverAFieldOfABallIsAsFarAsItsNearestPoint) {
  Random random(6);
  constexpr double kOfTheMesh = 3e-5;  // its flats lie so deep under the ball
  int looked = 0;
  for (int i = 0; i < 2000 && looked < 150; ++i) {
    const Primitive box = random_box(random);
    const Pose X_AB = shapes::random_pose(random, 0.02);
    const Vec3 center_B = (X_AB * box.X_TB).inverse() * Vec3::Zero();
    const Vec3 nearest = center_B.cwiseMax(-box.half).cwiseMin(box.half);
    const double expected = (center_B - nearest).norm() - 0.008;
    if (expected < -0.0003 || expected > 0.003) continue;
    ++looked;
    const PrimitiveContact contact = primitive_contact(round_field(), box, X_AB);
    ASSERT_EQ(contact.status, LpStatus::kOptimal);
    EXPECT_NEAR(contact.gap, expected, kOfTheMesh);
    const Vec3 up = ((X_AB * box.X_TB) * nearest).normalized();
    EXPECT_GT(contact.nhat_AB_A.dot(up), 0.998);
    // Told as a bound it is never too far.
    const PrimitiveContact bound = primitive_contact(round_field(), box, X_AB, 0.001);
    EXPECT_LT(bound.gap, contact.gap + 1e-9);
    if (contact.gap < 0.0009) {
      EXPECT_NEAR(bound.gap, contact.gap, 1e-9);
    }
  }
  EXPECT_EQ(looked, 150);
}

// Moved a little, a box is as far as a whole search finds; moved more, it is searched anew.
TEST(PrimitiveContact, ABoxIsFoundFromItsLowPlacesAsFromAnew) {
  Random random(9);
  int looked = 0, about = 0;
  for (int i = 0; i < 3000 && looked < 100; ++i) {
    const Primitive box = random_box(random);
    Pose X_AB = shapes::random_pose(random, 0.02);
    LowPlaces places;
    const PrimitiveContact first = primitive_contact(round_field(), box, X_AB, 0.003, &places);
    if (first.status != LpStatus::kOptimal || first.gap < 1e-5 || first.gap > 0.002) continue;
    ++looked;
    EXPECT_FALSE(places.looked_about);
    ASSERT_GE(places.count, 1u);
    for (int step = 0; step < 8; ++step) {
      X_AB.p += 3e-5 * random.direction();
      const Quat turn(Eigen::AngleAxisd(1e-4, random.direction()));
      X_AB.q = (turn * X_AB.q).normalized();
      const PrimitiveContact moved = primitive_contact(round_field(), box, X_AB, 0.003, &places);
      const PrimitiveContact whole = primitive_contact(round_field(), box, X_AB, 0.003);
      about += places.looked_about ? 1 : 0;
      // The whole search may end a little higher.
      EXPECT_LT(moved.gap, whole.gap + 2e-7) << i << ", " << step;
      EXPECT_GT(moved.gap, whole.gap - 1e-6) << i << ", " << step;
      EXPECT_GT(moved.nhat_AB_A.dot(whole.nhat_AB_A), 0.9999);
    }
    X_AB.p.x() += 0.001;
    (void)primitive_contact(round_field(), box, X_AB, 0.003, &places);
    EXPECT_FALSE(places.looked_about);
    X_AB.p.x() += 1;
    (void)primitive_contact(round_field(), box, X_AB, 0.003, &places);
    EXPECT_EQ(places.count, 0u) << "what is beyond has no lowest place";
  }
  EXPECT_EQ(looked, 100);
  EXPECT_GT(about, 200);
}

// On a cube's flat field every part of a face that lies on it is as low as the next.
TEST(PrimitiveContact, ABoxFlatOnAFieldIsFoundAsLow) {
  FieldOptions options;
  options.outside_m = 0.002;
  const DistanceField field = std::move(DistanceField::make(test::cube(0.006), options).value());
  const Primitive box = make_box({}, Vec3(0.003, 0.002, 0.001));
  for (const double tilt : {0.0, 1e-3, 0.1}) {
    const Pose X_AB{Vec3(0.001, 0, 0.0075), Quat(std::cos(tilt / 2), std::sin(tilt / 2), 0, 0)};
    const double lowest = 0.0075 - 0.002 * std::sin(tilt) - 0.001 * std::cos(tilt) - 0.006;
    const PrimitiveContact contact = primitive_contact(field, box, X_AB);
    EXPECT_NEAR(contact.gap, lowest, 1e-6) << tilt;
    EXPECT_GT(contact.nhat_AB_A.z(), 0.999);
  }
}

TEST(PrimitiveContact, ALongRodsBoundIsNeverTooFar) {
  Random random(7);
  constexpr double kOfTheMesh = 3e-5;  // its flats lie so deep under the ball
  constexpr double kFar = 0.001;
  constexpr double kDeep = -0.004;  // beyond what the field knows of the inside
  int near = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random_point(random, 0.012);
    const Vec3 along = 0.15 * random.direction();
    const double s = std::clamp(-p.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const double gap = (p + s * along).norm() - 0.009;
    if (gap < kDeep) continue;
    const PrimitiveContact bound =
        primitive_contact(round_field(), make_rod(p, p + along, 0.001), {}, kFar);
    ASSERT_EQ(bound.status, LpStatus::kOptimal);
    EXPECT_LT(bound.gap, gap + kOfTheMesh) << i;
    if (gap > kFar) continue;
    EXPECT_NEAR(bound.gap, gap, kOfTheMesh) << i;
    ++near;
  }
  EXPECT_GT(near, 30);
}

}  // namespace
}  // namespace osteon
