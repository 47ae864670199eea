// Balls whose scan is computed voxel by voxel give their surface back.
#include "osteon/mesh/bone_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"
#include "osteon/mesh/decimate.h"
#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/taubin.h"

namespace osteon {
namespace {

constexpr double kRadius_m = 0.006;
const Vec3 kMiddle(0.009, 0.0085, 0.0095);

/// A shell with marrow in soft tissue, each voxel the mean over 4 x 4 x 4 points, with noise.
struct Scan {
  Volume volume;
  LabelVolume labels;
  VoxelBox box;
};
Scan scan_ball(double slice_m, double noise_hu) {
  Scan scan;
  GridFrame& frame = scan.volume.frame;
  frame.spacing_m = Vec3(0.0005, 0.0005, slice_m);
  frame.size = {36, 36, static_cast<int>(std::lround(0.018 / slice_m))};
  Random random(9);
  scan.labels.frame = frame;
  for (int k = 0; k < frame.size[2]; ++k)
    for (int j = 0; j < frame.size[1]; ++j)
      for (int i = 0; i < frame.size[0]; ++i) {
        double sum = 0;
        for (int s = 0; s < 64; ++s) {
          const Vec3 part((s % 4 - 1.5) / 4, (s / 4 % 4 - 1.5) / 4, (s / 16 - 1.5) / 4);
          const double d = (frame.point_P(Vec3(i, j, k) + part) - kMiddle).norm() - kRadius_m;
          sum += d > 0 ? 50 : d > -0.0012 ? 1500 : 350;
        }
        const double hu = random.normal(sum / 64, noise_hu);
        scan.volume.values.push_back(static_cast<std::int16_t>(std::lround(hu)));
        const bool inside = (frame.point_P(Vec3(i, j, k)) - kMiddle).norm() < kRadius_m;
        scan.labels.values.push_back(inside || hu > 500 ? 7 : 0);
      }
  scan.box = {{2, 2, 1}, {34, 34, frame.size[2] - 1}};
  return scan;
}

double mean_error_m(const TriMesh& mesh, const Vec3& middle = kMiddle) {
  double sum = 0;
  for (const Vec3& v : mesh.vertices) sum += std::abs((v - middle).norm() - kRadius_m);
  return sum / static_cast<double>(mesh.vertices.size());
}

TEST(BoneSurface, ABallIsFoundWithinASixthOfAVoxelWhateverTheThreshold) {
  const Scan scan = scan_ball(0.0005, 30);
  for (const double threshold : {300.0, 500.0, 800.0}) {
    BoneSurfaceOptions options;
    options.threshold_hu = threshold;
    const auto mesh = bone_surface(scan.volume, scan.labels, 7, scan.box, options);
    ASSERT_TRUE(mesh) << mesh.error().message();
    EXPECT_TRUE(topology(*mesh).closed());
    EXPECT_LT(mean_error_m(*mesh), 0.0005 / 6) << threshold;
    EXPECT_NEAR(volume(*mesh) / (4.0 / 3 * M_PI * std::pow(kRadius_m, 3)), 1, 0.03);
  }
}

TEST(BoneSurface, ThickSlicesStayWithinAVoxel) {
  const Scan scan = scan_ball(0.002, 30);
  BoneSurfaceOptions options;
  options.threshold_hu = 500;
  const auto mesh = bone_surface(scan.volume, scan.labels, 7, scan.box, options);
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_TRUE(topology(*mesh).closed());
  EXPECT_LT(mean_error_m(*mesh), 0.0005);
}

TEST(BoneSurface, FollowsTheScansFrame) {
  Scan scan = scan_ball(0.0005, 0);
  const Quat q(Eigen::AngleAxisd(0.7, Vec3(1, -2, 0.5).normalized()));
  for (GridFrame* frame : {&scan.volume.frame, &scan.labels.frame}) {
    frame->axes_P = q.toRotationMatrix();
    frame->origin_P = Vec3(0.1, -0.2, 0.3);
  }
  const auto mesh = bone_surface(scan.volume, scan.labels, 7, scan.box, {});
  ASSERT_TRUE(mesh);
  EXPECT_LT(mean_error_m(*mesh, Vec3(0.1, -0.2, 0.3) + q * kMiddle), 0.0001);
  EXPECT_GT(volume(*mesh), 0);
}

TEST(BoneSurface, ALabelThatIsNowhereIsAnError) {
  const Scan scan = scan_ball(0.0005, 0);
  EXPECT_FALSE(bone_surface(scan.volume, scan.labels, 3, {{2, 2, 2}, {5, 5, 5}}, {}));
}

TriMesh field_ball() {
  return *isosurface([](const Vec3& p) { return p.norm() - kRadius_m; },
                     {Vec3::Constant(-0.008), Vec3::Constant(0.008)}, {});
}

TEST(Taubin, TakesNoiseAwayAndKeepsTheVolume) {
  TriMesh mesh = field_ball();
  const double before_m3 = volume(mesh);
  Random random(2);
  for (Vec3& v : mesh.vertices) v += random.normal(0, 0.0001) * v.normalized();
  const double rough_m = mean_error_m(mesh, Vec3::Zero());
  smooth_taubin(mesh);
  EXPECT_LT(mean_error_m(mesh, Vec3::Zero()), 0.5 * rough_m);
  EXPECT_NEAR(volume(mesh) / before_m3, 1, 0.005);
}

TEST(Taubin, RingsNameEveryNeighbourOnce) {
  const TriMesh mesh = field_ball();
  const VertexRings rings = vertex_rings(mesh);
  EXPECT_EQ(rings.neighbour.size(), 3 * mesh.triangles.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    for (std::uint32_t a = rings.first[v]; a < rings.first[v + 1]; ++a) {
      EXPECT_NE(rings.neighbour[a], v);
      for (std::uint32_t b = a + 1; b < rings.first[v + 1]; ++b)
        EXPECT_NE(rings.neighbour[a], rings.neighbour[b]);
    }
}

TEST(Decimate, TakesTrianglesAndKeepsTheSurfaceClosedAndInPlace) {
  TriMesh mesh = field_ball();
  const std::size_t before = mesh.triangles.size();
  decimate(mesh, 0.00005);
  EXPECT_LT(mesh.triangles.size(), before / 3);
  EXPECT_GE(mesh.triangles.size(), 190u);
  EXPECT_TRUE(topology(mesh).closed());
  EXPECT_LT(mean_error_m(mesh, Vec3::Zero()), 0.0001);
}

TEST(Decimate, LeavesSmallMeshesAlone) {
  TriMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  mesh.triangles = {{0, 1, 2}};
  decimate(mesh, 1);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

}  // namespace
}  // namespace osteon
