// Where a ligament grows into bone its surface meets it in a smooth line, whatever its cells were.
#include "surface/rooted.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../scenes.h"
#include "surface/moved_light.h"

namespace osteon {
namespace {

constexpr double kBall_m = 0.010, kTube_m = 0.004, kCell_m = 0.0005;
constexpr int kSides = 48, kRows = 24;

// A tube that ends in a ball of bone, in steps: every other place of its lower rim is nearer to its
// axis and higher.
Case tube_on_ball() {
  Case made;
  made.bones.push_back(make_bone("ball", sphere_mesh(kBall_m), Vec3::Zero()));
  SoftPart soft;
  soft.name = soft.kind = "ligament";
  soft.bones = {BoneId{0}};
  TriMesh& mesh = soft.mesh_W;
  const double on_bone = std::sqrt(kBall_m * kBall_m - kTube_m * kTube_m);
  for (int row = 0; row < kRows; ++row)
    for (int k = 0; k < kSides; ++k) {
      const double a = 2 * std::numbers::pi * k / kSides;
      const bool rim = row < 2 && k % 2 == 0;
      const double r = rim ? kTube_m - 0.6 * kCell_m : kTube_m;
      const double z = on_bone + kCell_m * (row - 0.7 + (rim ? 0.3 : 0));
      mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  for (std::uint32_t row = 0; row + 1 < kRows; ++row)
    for (std::uint32_t k = 0; k < kSides; ++k) {
      const std::uint32_t a = row * kSides + k, b = row * kSides + (k + 1) % kSides;
      mesh.triangles.push_back({a, b, b + kSides});
      mesh.triangles.push_back({a, b + kSides, a + kSides});
    }
  made.softs.push_back(soft);
  return made;
}

/// Where lines along the tube meet the ball: how much their distances from the axis differ.
double rim_spread(const std::vector<Vec3>& points) {
  double least = 1, most = 0;
  for (std::size_t k = 0; k < kSides; ++k)
    for (std::size_t row = 0; row + 1 < kRows; ++row) {
      const Vec3 &a = points[row * kSides + k], &b = points[(row + 1) * kSides + k];
      const double below = a.norm() - kBall_m, above = b.norm() - kBall_m;
      if (!(below <= 0 && above > 0)) continue;
      const Vec3 at = a + below / (below - above) * (b - a);
      least = std::min(least, std::hypot(at.x(), at.y()));
      most = std::max(most, std::hypot(at.x(), at.y()));
    }
  return most - least;
}

TEST(Rooted, TheLineWhereItMeetsBoneIsSmooth) {
  const Case made = tube_on_ball();
  Surface s = make_surface(made.softs[0].mesh_W);
  const std::vector<Vec3> before = s.points;
  const double steps = rim_spread(before);
  ASSERT_GT(steps, 0.2 * kCell_m);
  const auto roots = find_roots(made, made.softs[0], s);
  draw_in(roots, s);
  EXPECT_LT(rim_spread(s.points), 0.15 * steps);
  for (std::size_t k = 0; k < kSides; ++k) {
    EXPECT_LT(s.points[k].norm(), kBall_m - 0.2 * kCell_m) << "its end lies in bone";
    EXPECT_EQ(s.points[12 * kSides + k], before[12 * kSides + k]) << "far from bone";
  }
}

TEST(Rooted, OfWhatDoesNotGrowIntoThatBoneNothingMoves) {
  Case made = tube_on_ball();
  const Surface s = make_surface(made.softs[0].mesh_W);
  EXPECT_FALSE(find_roots(made, made.softs[0], s).empty());
  SoftPart fat = made.softs[0], other = made.softs[0];
  fat.kind = "fat";
  other.bones.clear();
  EXPECT_TRUE(find_roots(made, fat, s).empty());
  EXPECT_TRUE(find_roots(made, other, s).empty());
  EXPECT_TRUE(find_roots(made, made.softs[0], Surface{}).empty());
}

// What lies in bone sees none of the sky: it must not darken what comes out of it.
TEST(Rooted, WhatIsBuriedHasTheLightOfWhatIsBesideIt) {
  const Case made = tube_on_ball();
  const ShadedMesh mesh = prepare_case(made).softs[0];
  int darkest = 255, beside = 255, buried = 0;
  std::vector<bool> in_bone(mesh.positions.size(), false);
  for (const ShadedMesh::Root& root : mesh.roots) in_bone[root.vertex] = root.buried;
  for (std::size_t v = 0; v < in_bone.size(); ++v) {
    int& least = in_bone[v] ? darkest : beside;
    least = std::min<int>(least, mesh.shades[v].openness);
    buried += in_bone[v] ? 1 : 0;
  }
  EXPECT_GE(buried, kSides);
  EXPECT_GE(darkest, beside - 12);
}

TEST(Rooted, APartThatGivesWayStaysDrawnIntoBone) {
  const Case made = tube_on_ball();
  const ShadedMesh mesh = prepare_case(made).softs[0];
  const TriMesh& rest = made.softs[0].mesh_W;
  const RestLight light(mesh.shades, mesh.roots);
  const ShadedMesh still = moved_light(rest, light, rest);
  EXPECT_EQ(still.positions, mesh.positions);
  EXPECT_EQ(still.normals, mesh.normals);
  TriMesh moved = rest;
  for (Vec3& p : moved.vertices) p.x() += 0.25 * std::max(p.z() - 0.012, 0.0);
  const ShadedMesh bent = moved_light(rest, light, moved);
  ASSERT_EQ(bent.positions.size(), mesh.positions.size());
  EXPECT_EQ(bent.positions[0], mesh.positions[0]);
  EXPECT_NE(bent.positions.back(), mesh.positions.back());
  EXPECT_NE(moved_light(rest, mesh.shades, rest).positions[0], mesh.positions[0]);
}

}  // namespace
}  // namespace osteon
