#include "osteon/scene/felt_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "../../mesh/shapes.h"

namespace osteon {
namespace {

Hull hull_of(const std::vector<Vec3>& points) { return std::move(build_hull(points).hull.value()); }

Bone bone_of(TriMesh mesh, std::vector<Hull> pieces) {
  Bone bone;
  bone.mesh = std::move(mesh);
  bone.pieces = std::move(pieces);
  return bone;
}

Hull box(const Vec3& lo, const Vec3& hi) {
  std::vector<Vec3> corners;
  for (const double x : {lo.x(), hi.x()})
    for (const double y : {lo.y(), hi.y()})
      for (const double z : {lo.z(), hi.z()}) corners.emplace_back(x, y, z);
  return hull_of(corners);
}

TEST(FeltDistance, WithoutAMeshItIsNothing) {
  const FeltDistance d = felt_distance(Bone{});
  EXPECT_EQ(d.mesh_to_felt.max, 0);
  EXPECT_EQ(d.felt_to_mesh.max, 0);
  EXPECT_TRUE(felt_heights(Bone{}, {}).empty());
}

TEST(FeltDistance, AConvexBoneIsItsHull) {
  const TriMesh cube = test::cube(0.004);
  const Bone bone = bone_of(cube, {hull_of(cube.vertices)});
  const FeltDistance d = felt_distance(bone);
  EXPECT_LT(d.mesh_to_felt.max, 1e-12);
  EXPECT_LT(d.felt_to_mesh.max, 1e-12);
  for (const double h : felt_heights(bone, bone.mesh.vertices)) EXPECT_NEAR(h, 0, 1e-12);
}

// The faces between two halves, and those within crossing pieces, are not felt.
TEST(FeltDistance, FacesBetweenPiecesDoNotCount) {
  const Vec3 lo = Vec3::Constant(-0.004), hi = Vec3::Constant(0.004);
  const Bone halves = bone_of(test::cube(0.004), {box(lo, Vec3(0.0001, 0.004, 0.004)),
                                                  box(Vec3(0.0001, -0.004, -0.004), hi)});
  EXPECT_LT(felt_distance(halves).felt_to_mesh.max, 1e-9);
  EXPECT_LT(felt_distance(halves).mesh_to_felt.max, 1e-9);
  const Bone crossing = bone_of(test::cube(0.004), {box(lo, Vec3(0.001, 0.004, 0.004)),
                                                    box(Vec3(-0.001, -0.004, -0.004), hi)});
  EXPECT_LT(felt_distance(crossing).felt_to_mesh.max, 1e-9);
}

TEST(FeltDistance, AHullOverAStepIsFarFromItsBottom) {
  // A cube without a quarter: the hull spans the step as a slope.
  TriMesh step;
  const std::vector<Vec3> profile{Vec3(-4, 0, -4), Vec3(4, 0, -4), Vec3(4, 0, 0),
                                  Vec3(0, 0, 0),   Vec3(0, 0, 4),  Vec3(-4, 0, 4)};
  for (const double y : {-0.004, 0.004})
    for (const Vec3& p : profile) step.vertices.push_back(0.001 * p + Vec3(0, y, 0));
  step.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 3, 5},  {3, 4, 5},
                    {6, 9, 7}, {7, 9, 8}, {6, 11, 9}, {9, 11, 10}};
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t n = (k + 1) % 6;
    step.triangles.push_back({k, k + 6, n});
    step.triangles.push_back({n, k + 6, n + 6});
  }
  const Bone bone = bone_of(step, {hull_of(step.vertices)});
  const FeltDistance d = felt_distance(bone);
  const double slope = 0.004 / std::sqrt(2.0);  // of the inner edge to the plane over it
  EXPECT_NEAR(d.mesh_to_felt.max, slope, 0.0003);
  EXPECT_GT(d.felt_to_mesh.max, 0.0015);
  const std::vector<Vec3> middle_of_the_step{Vec3::Zero()};
  EXPECT_NEAR(felt_heights(bone, middle_of_the_step)[0], slope, 1e-9);
}

TEST(FeltDistance, AThickerBallStandsOverTheMesh) {
  const Bone bone = bone_of(test::sphere(0.005, 40), {hull_of(test::sphere(0.0051, 40).vertices)});
  const FeltDistance d = felt_distance(bone);
  EXPECT_NEAR(d.mesh_to_felt.mean, 1e-4, 2e-6);
  EXPECT_NEAR(d.felt_to_mesh.mean, 1e-4, 2e-6);
  EXPECT_GE(d.mesh_to_felt.p95, d.mesh_to_felt.mean);
  EXPECT_GE(d.mesh_to_felt.max, d.mesh_to_felt.p95);
  for (const double h : felt_heights(bone, bone.mesh.vertices)) EXPECT_NEAR(h, 1e-4, 5e-6);
}

TEST(FeltDistance, AFieldFollowsItsMesh) {
  Bone bone = bone_of(test::sphere(0.004, 40), {});
  bone.felt = Felt::kField;
  bone.field =
      std::make_shared<const DistanceField>(std::move(DistanceField::make(bone.mesh).value()));
  const FeltDistance d = felt_distance(bone);
  EXPECT_GT(d.felt_to_mesh.max, 0);
  EXPECT_LT(d.mesh_to_felt.max, 6e-6);
  EXPECT_LT(d.felt_to_mesh.max, 6e-6);
  EXPECT_LT(d.felt_to_mesh.mean, 3e-6);
}

}  // namespace
}  // namespace osteon
