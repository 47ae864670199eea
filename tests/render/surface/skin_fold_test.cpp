// Skin behind a bent knee lies in a fold.
#include "surface/skin_fold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../scenes.h"
#include "surface/moved_light.h"

namespace osteon {
namespace {

constexpr double kBack_m = 0.045, kFrontAt_m = 0.050, kSlope = 0.5;

/// A sheet behind the joint, hollow along the line x = 0, and one in front of it.
TriMesh two_sheets() {
  constexpr int kSteps = 48;
  constexpr double kWide_m = 0.060;
  TriMesh mesh;
  for (const bool back : {true, false}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) {
        const double x = kWide_m * (2.0 * i / kSteps - 1), y = kWide_m * (2.0 * j / kSteps - 1);
        mesh.vertices.emplace_back(x, y, back ? -kBack_m - kSlope * std::abs(x) : kFrontAt_m);
      }
    for (std::uint32_t i = 0; i < kSteps; ++i)
      for (std::uint32_t j = 0; j < kSteps; ++j) {
        const std::uint32_t a = first + i * (kSteps + 1) + j, b = a + kSteps + 1;
        const Triangle one{a, b, b + 1}, two{a, b + 1, a + 1};
        for (const Triangle& t : {one, two})
          mesh.triangles.push_back(back ? Triangle{t[0], t[2], t[1]} : t);
      }
  }
  return mesh;
}

/// Both bones leave the joint at the origin, the tibia turned from the femur's line by `bent_rad`
/// about y; skin is before and behind the joint.
Case bent_knee(double bent_rad) {
  Case knee;
  const auto add = [&](const char* name, const Vec3& way) {
    Bone bone;
    bone.name = name;
    for (int k = 0; k <= 20; ++k) bone.mesh.vertices.push_back((0.01 + 0.015 * k) * way);
    bone.mesh.triangles = {{0, 1, 2}};
    knee.bones.push_back(bone);
  };
  const double half = 0.5 * bent_rad;
  add("femur", Vec3(-std::cos(half), 0, -std::sin(half)));
  add("tibia", Vec3(std::cos(half), 0, -std::sin(half)));
  SoftPart skin;
  skin.name = skin.kind = "skin";
  skin.mesh_W = two_sheets();
  knee.softs.push_back(skin);
  return knee;
}

// The joint's front is z, its hollow -z.
const Vec3 kHollow(0, 0, -kBack_m), kFront(0, 0, kFrontAt_m);

/// How far the vertex nearest to `p` has moved, and its openness.
struct Moved {
  Vec3 by = Vec3::Zero();
  int open = 0;
};
Moved moved_at(const Vec3& p, const TriMesh& rest, const ShadedMesh& shown) {
  const Surface s = make_surface(rest);
  std::size_t at = 0;
  for (std::size_t k = 0; k < s.points.size(); ++k)
    if ((s.points[k] - p).norm() < (s.points[at] - p).norm()) at = k;
  const auto& q = shown.positions[at];
  return {Eigen::Vector3f(q[0], q[1], q[2]).cast<double>() - s.points[at],
          shown.shades[at].openness};
}

TEST(SkinFold, SkinGoesInBehindABentKneeAndSwellsBesideTheFold) {
  const Case knee = bent_knee(2.1);
  const TriMesh& rest = knee.softs[0].mesh_W;
  const ShadedMesh skin = prepare_case(knee).softs[0];
  const Moved in = moved_at(kHollow, rest, skin);
  EXPECT_NEAR(in.by.z(), 0.016, 0.001);
  EXPECT_LT(in.open, 150);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 beside(0.020 * side, 0, -kBack_m - kSlope * 0.020);
    const Moved out = moved_at(beside, rest, skin);
    EXPECT_LT(out.by.z(), -0.002);
    EXPECT_GT(out.open, 200);
  }
  EXPECT_LT(moved_at(kFront, rest, skin).by.norm(), 1e-6);
  EXPECT_EQ(moved_at(kFront, rest, skin).open, 255);
}

TEST(SkinFold, IsTheDeeperTheFartherAKneeIsBent) {
  double before = 0;
  for (const double bent_rad : {1.0, 1.3, 1.6, 2.0}) {
    const Case knee = bent_knee(bent_rad);
    const double deep =
        moved_at(kHollow, knee.softs[0].mesh_W, prepare_unlit(knee).softs[0]).by.z();
    EXPECT_GT(deep, before + 0.001);
    before = deep;
  }
}

TEST(SkinFold, OfAStraightKneeOrNoKneeThereIsNone) {
  for (const double bent_rad : {0.0, 0.3, 0.69}) {
    const Case knee = bent_knee(bent_rad);
    EXPECT_TRUE(find_fold(knee, make_surface(knee.softs[0].mesh_W)).empty());
  }
  Case other = bent_knee(2.1);
  other.bones[0].name = "humerus";
  EXPECT_TRUE(find_fold(other, make_surface(other.softs[0].mesh_W)).empty());
  EXPECT_TRUE(find_fold(bent_knee(2.1), Surface{}).empty());
}

TEST(SkinFold, StaysWhereSkinIsCut) {
  const Case knee = bent_knee(2.1);
  const TriMesh& rest = knee.softs[0].mesh_W;
  const ShadedMesh skin = prepare_case(knee).softs[0];
  const std::vector<float> depth_m(rest.vertices.size(), 0.0f);
  const ShadedMesh opened = opened_light(rest, {skin.shades, skin.roots}, rest, depth_m);
  EXPECT_EQ(opened.positions, skin.positions);
}

}  // namespace
}  // namespace osteon
