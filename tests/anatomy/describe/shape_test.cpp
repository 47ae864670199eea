#include "describe/shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

void add_part(Solid& solid, Operation operation, const Primitive& primitive, double blend) {
  Part part;
  part.operation = operation;
  part.primitive = primitive;
  part.blend = blend;
  solid.parts.push_back(part);
}

Vec3 random_place(Random& random, double half) {
  const double x = random.uniform(-half, half);
  const double y = random.uniform(-half, half);
  const double z = random.uniform(-half, half);
  return {x, y, z};
}

/// Distance to the union of many spheres along a straight cone: a slow oracle.
double swept_spheres(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  double best = 1e300;
  for (int i = 0; i <= 20000; ++i) {
    const double t = i / 20000.0;
    best = std::min(best, (p - (a + t * (b - a))).norm() - (ra + t * (rb - ra)));
  }
  return best;
}

TEST(Shape, EllipsoidIsFiniteAndNegativeAtItsCentre) {
  const Ellipsoid e{Vec3(1, 2, 3), Vec3(0.3, 0.2, 0.1), Mat3::Identity()};
  EXPECT_EQ(distance(e, e.center), -0.1);
  EXPECT_LT(distance(e, Vec3(e.center + Vec3(1e-9, 0, 0))), 0);
}

TEST(Shape, EllipsoidOfEqualRadiiIsASphere) {
  const Ellipsoid e{Vec3(0.1, 0, 0), Vec3::Constant(0.5), rotation_xyz_deg({10, 20, 30})};
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = random_place(random, 2);
    EXPECT_NEAR(distance(e, p), (p - e.center).norm() - 0.5, 1e-12);
  }
}

TEST(Shape, EllipsoidIsFirstOrderDistanceAtItsSurface) {
  const Ellipsoid e{Vec3(0.1, -0.2, 0.3), Vec3(1.0, 0.6, 0.4), rotation_xyz_deg({40, -70, 155})};
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 u = random.direction();
    const Vec3 on = e.R_local.transpose() * u.cwiseProduct(e.radii) + e.center;
    const Vec3 normal = (e.R_local.transpose() * u.cwiseQuotient(e.radii)).normalized();
    EXPECT_NEAR(distance(e, on), 0, 1e-12);
    for (const double off : {-1e-4, 1e-4}) EXPECT_NEAR(distance(e, on + off * normal), off, 1e-7);
  }
}

TEST(Shape, TubeOfTwoPointsIsARoundCone) {
  const Vec3 a(0, 0, 0), b(1, 0.4, -0.2);
  const Tube cone = tube_through({a, b}, {0.3, 0.1});
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = random_place(random, 2);
    EXPECT_NEAR(distance(cone, p), swept_spheres(p, a, b, 0.3, 0.1), 1e-4);
  }
}

TEST(Shape, TubeWhoseOneSphereHoldsTheOtherIsThatSphere) {
  const Tube fat = tube_through({Vec3(0, 0, 0), Vec3(0.1, 0, 0)}, {1.0, 0.2});
  EXPECT_NEAR(distance(fat, Vec3(0, 3, 0)), 2, 1e-12);
  EXPECT_NEAR(distance(fat, Vec3(3, 0, 0)), 2, 1e-12);
  const Tube late = tube_through({Vec3(0, 0, 0), Vec3(0.1, 0, 0)}, {0.2, 1.0});
  EXPECT_NEAR(distance(late, Vec3(3.1, 0, 0)), 2, 1e-12);
}

TEST(Shape, TubePassesThroughItsPointsWithTheirRadii) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 2, 1}};
  const std::vector<double> radii = {0.2, 0.3, 0.25, 0.1};
  const Tube tube = tube_through(points, radii);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LE(distance(tube, points[i]), -radii[i] + 1e-12);
  EXPECT_EQ(tube.points.size(), 19u);
}

/// Skipping far cones changes no more than the rounding.
TEST(Shape, TubeEqualsTheNearestOfItsCones) {
  const Tube tube =
      tube_through({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 2, 1}}, {0.2, 0.4, 0.2, 0.1});
  Random random(9);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random_place(random, 3);
    double nearest = 1e300;
    for (std::size_t k = 0; k + 1 < tube.points.size(); ++k)
      nearest = std::min(nearest, distance(tube_through({tube.points[k], tube.points[k + 1]},
                                                        {tube.radii[k], tube.radii[k + 1]}),
                                           p));
    EXPECT_NEAR(distance(tube, p), nearest, 1e-14);
  }
}

TEST(Shape, BoxWithoutRoundingHasFlatFaces) {
  const RoundedBox box{Vec3::Zero(), Vec3(1, 2, 3), 0, Mat3::Identity()};
  EXPECT_DOUBLE_EQ(distance(box, Vec3(1.5, 0, 0)), 0.5);
  EXPECT_DOUBLE_EQ(distance(box, Vec3(0, 0, 0)), -1);
  EXPECT_DOUBLE_EQ(distance(box, Vec3(1, 5, 7)), 5);
}

TEST(Shape, BoxRoundedToTheFullIsABall) {
  const RoundedBox box{Vec3::Zero(), Vec3::Constant(2), 2, rotation_xyz_deg({30, 40, 50})};
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    const Vec3 p = random_place(random, 5);
    EXPECT_NEAR(distance(box, p), p.norm() - 2, 1e-12);
  }
}

TEST(Shape, SmoothMinimumWithoutRadiusIsTheMinimum) {
  EXPECT_EQ(smooth_min(1, 2, 0), 1);
  EXPECT_EQ(smooth_min(1, 1, 0), 1);
  EXPECT_EQ(smooth_max(1, 2, 0), 2);
}

TEST(Shape, SmoothMinimumIsLowerByAtMostAQuarterOfItsRadius) {
  Random random(13);
  for (int i = 0; i < 1000; ++i) {
    const double a = random.uniform(-1, 1);
    const double b = random.uniform(-1, 1);
    const double k = random.uniform(0, 2);
    const double s = smooth_min(a, b, k);
    EXPECT_LE(s, std::min(a, b));
    EXPECT_GE(s, std::min(a, b) - k / 4 - 1e-15);
    EXPECT_EQ(s, smooth_min(b, a, k));
    if (std::abs(a - b) >= k) {
      EXPECT_EQ(s, std::min(a, b));
    }
  }
}

TEST(Shape, CutTakesAway) {
  Solid solid;
  add_part(solid, Operation::kAdd, Ellipsoid{}, 0);
  add_part(solid, Operation::kCut, HalfSpace{Vec3::Zero(), Vec3::UnitX()}, 0);
  EXPECT_GT(distance(solid, Vec3(-0.5, 0, 0)), 0);
  EXPECT_LT(distance(solid, Vec3(0.5, 0, 0)), 0);
  EXPECT_EQ(distance(solid, Vec3(-0.5, 0, 0)), 0.5);
}

/// What the surface finder relies on: |value| <= stretch * distance, and nothing inside lies
/// outside the bounds.
TEST(Shape, BoundsAndStretchHold) {
  Random random(17);
  for (int trial = 0; trial < 20; ++trial) {
    Ellipsoid e;
    e.center = random_place(random, 1);
    e.radii = random_place(random, 0.4) + Vec3::Constant(0.5);
    e.R_local = random.rotation().toRotationMatrix();
    const Aabb box = bounds(Primitive{e});
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = e.center + random_place(random, 1.5);
      const double value = distance(e, p);
      if (value < 0) {
        EXPECT_TRUE(box.overlaps({p, p}));
      }
      const double k0 = (e.R_local * (p - e.center)).cwiseQuotient(e.radii).norm();
      const double sure = std::abs(k0 - 1) * e.radii.minCoeff();  // never more than the distance
      EXPECT_LE(std::abs(value), stretch(Primitive{e}) * sure + 1e-12);
    }
  }
}

TEST(Shape, RotationAgreesWithTheLibrarysSinesAndIsExactAtRightAngles) {
  const Mat3 quarter = rotation_xyz_deg({0, 0, 90});
  EXPECT_EQ(quarter * Vec3::UnitX(), Vec3::UnitY());
  EXPECT_EQ(rotation_xyz_deg({0, 0, 0}), Mat3::Identity());
  EXPECT_EQ(rotation_xyz_deg({360, -720, 0}), Mat3::Identity());
  constexpr double kDegree = 3.14159265358979323846 / 180;
  Random random(19);
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = random_place(random, 360);
    const Mat3 want = (Eigen::AngleAxisd(a.z() * kDegree, Vec3::UnitZ()) *
                       Eigen::AngleAxisd(a.y() * kDegree, Vec3::UnitY()) *
                       Eigen::AngleAxisd(a.x() * kDegree, Vec3::UnitX()))
                          .toRotationMatrix();
    EXPECT_LT((rotation_xyz_deg(a) - want).cwiseAbs().maxCoeff(), 2e-15);
  }
}

}  // namespace
}  // namespace osteon
