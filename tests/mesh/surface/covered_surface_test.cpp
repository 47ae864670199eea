#include "osteon/mesh/covered_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/shapes.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

TriMesh turned(TriMesh mesh) {
  for (Triangle& t : mesh.triangles) test::flip(t);
  return mesh;
}

/// A box from corner to corner, outward.
TriMesh box_between(const Vec3& lo, const Vec3& hi) {
  TriMesh mesh = test::cube(0.5);
  for (Vec3& v : mesh.vertices) v = lo + (v + Vec3::Constant(0.5)).cwiseProduct(Vec3(hi - lo));
  return mesh;
}

double box_height(const Vec3& p, const Vec3& lo, const Vec3& hi) {
  const Vec3 q = (p - 0.5 * (lo + hi)).cwiseAbs() - 0.5 * (hi - lo);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

CoveredSurface covered(const TriMesh& bone, const std::vector<TriMesh>& layers) {
  auto made = CoveredSurface::make(bone, layers);
  EXPECT_TRUE(made) << (made ? "" : made.error().message());
  return std::move(*made);
}

TEST(CoveredSurface, OfAShellTheOuterSphereIsTouched) {
  const TriMesh bone = test::sphere(0.008, 24);
  const TriMesh shell = test::joined(test::sphere(0.010, 24), turned(bone));
  const CoveredSurface body = covered(bone, {shell});
  EXPECT_EQ(body.touched().triangles.size(), bone.triangles.size());
  const MeshDistance outer(test::sphere(0.010, 24));
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(random.uniform(-0.012, 0.012), random.uniform(-0.012, 0.012),
                 random.uniform(-0.012, 0.012));
    EXPECT_NEAR(body.closest(p).signed_distance, outer.closest(p).signed_distance, 1e-12);
  }
}

TEST(CoveredSurface, WithoutLayersItIsTheBone) {
  const TriMesh bone = test::cube(0.004);
  const CoveredSurface body = covered(bone, {});
  EXPECT_EQ(body.touched().triangles.size(), bone.triangles.size());
  EXPECT_NEAR(body.closest(Vec3(0.001, 0, 0.005)).signed_distance, 0.001, 1e-12);
}

// A slab in the middle of a face, whose triangles know nothing of it: as a step on the box. It
// lies on the face, in it, or a little over it.
TEST(CoveredSurface, OfASlabOnABoxTheStepIsTouched) {
  const Vec3 half(0.006, 0.006, 0.006), lo(-0.002, -0.003, 0), hi(0.0025, 0.003, 0.008);
  const TriMesh bone = box_between(-half, half);
  for (const double base : {0.006, 0.0055, 0.0062}) {
    const Vec3 foot(lo.x(), lo.y(), base);
    const CoveredSurface body = covered(bone, {box_between(foot, hi)});
    const Vec3 rim(lo.x(), lo.y(), 0.006);
    Random random(9);
    int near = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 p(random.uniform(-0.007, 0.007), random.uniform(-0.007, 0.007),
                   random.uniform(0.002, 0.010));
      const double on_box = box_height(p, -half, half),
                   on_slab = box_height(p, Vec3(rim.x(), rim.y(), 0), hi);
      // Outside the smaller of two is exact; inside both faces that were joined are no surface.
      const double found = body.closest(p).signed_distance;
      const double wanted = std::min(on_box, on_slab);
      if (wanted > 0) {
        EXPECT_NEAR(found, wanted, 0.0002) << base << ": " << p.transpose();
        near += wanted < 0.0005;
      } else if (wanted < -0.00025) {
        EXPECT_LT(found, 0) << base << ": " << p.transpose();
      }
    }
    EXPECT_GT(near, 50);
    // In the slab, where the box ends, the slab's own faces are nearest: nothing lies between.
    EXPECT_NEAR(body.closest(Vec3(0, 0, 0.0061)).signed_distance, -0.0019, 0.00001) << base;
    EXPECT_NEAR(body.closest(Vec3(0, 0, 0.0058)).signed_distance, -std::hypot(0.002, 0.0002),
                0.0001)
        << base;
  }
}

TEST(CoveredSurface, TwoLayersSideBySideHaveNoFissure) {
  const Vec3 half = Vec3::Constant(0.006);
  const CoveredSurface body =
      covered(box_between(-half, half), {box_between({-0.004, -0.004, 0.006}, {0, 0.004, 0.008}),
                                         box_between({0, -0.004, 0.006}, {0.004, 0.004, 0.008})});
  EXPECT_NEAR(body.closest(Vec3(0, 0, 0.007)).signed_distance, -0.001, 1e-9);
  EXPECT_NEAR(body.closest(Vec3(0.0001, 0.001, 0.0065)).signed_distance, -0.0015, 1e-9);
}

TEST(CoveredSurface, RefusesWhatIsNotClosed) {
  TriMesh open = test::cube(0.004, Vec3(0, 0, 0.006));
  open.triangles.pop_back();
  const auto made = CoveredSurface::make(test::cube(0.004), {open});
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message().find("layer 1"), std::string::npos);
  TriMesh wild = test::cube(0.004);
  wild.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(CoveredSurface::make(wild, {}));
  EXPECT_FALSE(CoveredSurface::make(turned(test::cube(0.004)), {}));
  EXPECT_FALSE(CoveredSurface::make(TriMesh{}, {}));
}

}  // namespace
}  // namespace osteon
