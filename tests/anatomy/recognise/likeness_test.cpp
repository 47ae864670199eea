#include "osteon/anatomy/likeness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/shapes.h"

namespace osteon {
namespace {

/// A pear with a bent neck, about 4 cm long: no turn or mirror lays it over itself.
TriMesh pear(std::uint32_t rings = 24) {
  TriMesh mesh = test::sphere(1, rings);
  for (Vec3& v : mesh.vertices) {
    const double x = v.x(), y = v.y(), z = v.z();
    v = 0.001 * Vec3(20 * x, (11 - 4 * x) * y + 5 * x * x, (7 - 2 * x) * z + 3 * x * y + 2 * y);
  }
  return mesh;
}

TriMesh moved(TriMesh mesh, const Pose& X, double scale) {
  for (Vec3& v : mesh.vertices) v = X * (scale * v);
  return mesh;
}

Pose somewhere() {
  return {Vec3(0.3, -0.1, 0.05), Quat(Eigen::AngleAxisd(2.0, Vec3(1, -2, 0.5).normalized()))};
}

TEST(Likeness, ASurfaceThatWasTurnedMovedAndScaledLiesOnItself) {
  const TriMesh bone = pear();
  for (const double scale : {0.8, 1.25}) {
    const Likeness got = compare_surfaces(bone, moved(bone, somewhere(), scale));
    EXPECT_LT(got.mean_m, 0.00003);
    EXPECT_LT(got.p95_m, 0.0001);
    EXPECT_NEAR(got.scale, scale, 0.002);
  }
}

TEST(Likeness, ATriangleSoupIsAsGoodAReference) {
  EXPECT_LT(compare_surfaces(pear(), test::soup(pear(20))).mean_m, 0.0001);
}

TEST(Likeness, TheMirrorImageIsAnotherBone) {
  TriMesh other = pear();
  for (Vec3& v : other.vertices) v.y() = -v.y();
  for (Triangle& t : other.triangles) test::flip(t);
  EXPECT_GT(compare_surfaces(pear(), other).mean_m, 0.0003);
}

/// Ripples of amplitude A across a surface lie 2 A / pi away in the mean, and 95 % of them within
/// A sin(0.95 pi / 2).
TEST(Likeness, RipplesLieAtTheirClosedFormDistances) {
  constexpr double kAmplitude = 0.0004, kWaves = 12;
  const TriMesh smooth = test::sphere(1, 70);
  const auto grown = [&](double ripple) {
    TriMesh mesh = smooth;
    for (Vec3& v : mesh.vertices) {
      const double r = 0.02 + ripple * std::sin(kWaves * std::atan2(v.z(), v.x()) + 0.3);
      v = Vec3(v.x() * r, 2 * 0.02 * v.y(), v.z() * r);
    }
    return mesh;
  };
  const Likeness got = compare_surfaces(grown(0), grown(kAmplitude));
  // Towards the poles the ripples shrink with the radius, hence the lower bound of their mean.
  EXPECT_GT(got.mean_m, 0.72 * kAmplitude * 2 / M_PI);
  EXPECT_LT(got.mean_m, 1.0 * kAmplitude * 2 / M_PI);
  EXPECT_GT(got.p95_m, 0.85 * kAmplitude);
  EXPECT_LT(got.p95_m, 1.02 * kAmplitude);
}

/// A bone sawn through is compared at its end, on whichever end of the reference that lies.
TEST(Likeness, TheEndOfASawnBoneIsFoundOnTheWholeOne) {
  TriMesh whole = pear(40);
  for (Vec3& v : whole.vertices) v.x() *= 3;
  for (const double side : {1.0, -1.0}) {
    TriMesh sawn = whole;
    for (Vec3& v : sawn.vertices) v.x() = side * std::max(side * v.x(), -0.01);
    LikenessOptions end;
    end.end_m = 0.045;
    end.towards_end_B = Vec3(side, 0, 0);
    const TriMesh reference = moved(whole, somewhere(), 1.1);
    EXPECT_LT(compare_surfaces(sawn, reference, end).mean_m, 0.0002) << side;
    EXPECT_GT(compare_surfaces(sawn, reference).mean_m, 0.001) << side;
  }
}

TEST(Likeness, TheSameMeshesGiveTheSameFigures) {
  const TriMesh reference = moved(pear(), somewhere(), 1.1);
  const Likeness a = compare_surfaces(pear(20), reference),
                 b = compare_surfaces(pear(20), reference);
  EXPECT_EQ(a.mean_m, b.mean_m);
  EXPECT_EQ(a.p95_m, b.p95_m);
}

}  // namespace
}  // namespace osteon
