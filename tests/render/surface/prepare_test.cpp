#include "osteon/render/prepare.h"

#include <gtest/gtest.h>

#include <cstring>

#include "../scenes.h"

namespace osteon {
namespace {

/// Two balls of 5 mm that nearly touch at the origin.
Case pair_of_balls(double gap_m) {
  Case pair;
  const double x = 0.005 + gap_m / 2;
  pair.bones.push_back(make_bone("left", sphere_mesh(0.005), Vec3(-x, 0, 0)));
  pair.bones.push_back(make_bone("right", sphere_mesh(0.005), Vec3(x, 0, 0)));
  return pair;
}

/// Openness of the vertex furthest along `direction`.
int openness_towards(const ShadedMesh& mesh, const Vec3& direction) {
  std::size_t best = 0;
  double reach = -1e9;
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const auto& p = mesh.positions[k];
    const double along = direction.dot(Vec3(p[0], p[1], p[2]));
    if (along <= reach) continue;
    reach = along;
    best = k;
  }
  return mesh.shades[best].openness;
}

// The same surfaces at once, but for the light that is worked out between them.
TEST(PrepareUnlit, GivesTheSurfacesInAllOfTheLight) {
  EXPECT_TRUE(prepare_unlit({}).bones.empty());
  const Case pair = pair_of_balls(0.0005);
  const PreparedCase lit = prepare_case(pair), unlit = prepare_unlit(pair);
  ASSERT_EQ(unlit.bones.size(), 2u);
  ASSERT_LT(openness_towards(lit.bones[0], Vec3::UnitX()), 200);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(unlit.bones[k].positions, lit.bones[k].positions);
    EXPECT_EQ(unlit.bones[k].normals, lit.bones[k].normals);
    EXPECT_EQ(unlit.bones[k].triangles, lit.bones[k].triangles);
    for (std::size_t v = 0; v < unlit.bones[k].shades.size(); ++v) {
      EXPECT_EQ(unlit.bones[k].shades[v].openness, 255);
      EXPECT_EQ(unlit.bones[k].shades[v].cavity, lit.bones[k].shades[v].cavity);
    }
  }
}

// A hull that stands 0.25 mm over the mesh is half of the range.
TEST(PrepareFelt, TellsHowHighWhatIsFeltStands) {
  Case one;
  one.bones.push_back(make_bone("ball", sphere_mesh(0.005), Vec3::Zero()));
  PreparedCase without = prepare_case(one);
  prepare_felt(one, without);
  for (const ShadedMesh::Shade& s : without.bones[0].shades) EXPECT_EQ(s.felt, 128);
  one.bones[0].pieces = {*build_hull(sphere_mesh(0.00525).vertices).hull};
  PreparedCase over = prepare_case(one);
  for (const ShadedMesh::Shade& s : over.bones[0].shades) EXPECT_EQ(s.felt, 128) << "not asked for";
  prepare_felt(one, over);
  for (const ShadedMesh::Shade& s : over.bones[0].shades) EXPECT_NEAR(s.felt, 128 + 64, 2);
}

TEST(PrepareFelt, NothingAndStopping) {
  PreparedCase nothing;
  prepare_felt({}, nothing);
  Case pair = pair_of_balls(0.001);
  for (Bone& bone : pair.bones) bone.pieces = {*build_hull(sphere_mesh(0.00525).vertices).hull};
  PreparedCase prepared = prepare_case(pair);
  prepare_felt(pair, prepared, [](double share) {
    EXPECT_DOUBLE_EQ(share, 0.5);
    return false;
  });
  EXPECT_GT(prepared.bones[0].shades[0].felt, 128);
  EXPECT_EQ(prepared.bones[1].shades[0].felt, 128);
}

TEST(PrepareCase, EmptyCaseAndEmptyMesh) {
  EXPECT_TRUE(prepare_case({}).bones.empty());
  Case one;
  one.bones.push_back(make_bone("nothing", {}, Vec3::Zero()));
  const PreparedCase prepared = prepare_case(one);
  ASSERT_EQ(prepared.bones.size(), 1u);
  EXPECT_TRUE(prepared.bones[0].triangles.empty());
}

TEST(PrepareCase, ALoneBallSeesTheWholeSky) {
  Case one;
  one.bones.push_back(make_bone("ball", sphere_mesh(0.005), Vec3(0.1, 0, 0)));
  const PreparedCase prepared = prepare_case(one);
  ASSERT_FALSE(prepared.bones[0].shades.empty());
  for (const auto& shade : prepared.bones[0].shades) EXPECT_GE(shade.openness, 250);
}

TEST(PrepareCase, TheJointSpaceIsDarkAndTheOuterSidesAreNot) {
  const PreparedCase prepared = prepare_case(pair_of_balls(0.0005));
  EXPECT_LT(openness_towards(prepared.bones[0], Vec3::UnitX()), 80);
  EXPECT_GT(openness_towards(prepared.bones[0], -Vec3::UnitX()), 250);
  EXPECT_LT(openness_towards(prepared.bones[1], -Vec3::UnitX()), 80);
}

TEST(PrepareCase, OcclusionFadesWithTheGap) {
  int last = 0;
  for (const double gap_m : {0.001, 0.004, 0.008, 0.020}) {
    const int open = openness_towards(prepare_case(pair_of_balls(gap_m)).bones[0], Vec3::UnitX());
    EXPECT_GT(open, last);
    last = open;
  }
  EXPECT_GE(last, 250);
}

TEST(PrepareCase, CartilageTellsWhereItThinsOut) {
  constexpr double kBone_m = 0.010, kSag_m = 0.0001;
  Case made;
  made.bones.push_back(make_bone("ball", sphere_mesh(kBone_m), Vec3::Zero()));
  SoftPart cap;
  cap.name = cap.kind = "cartilage";
  cap.bones = {BoneId{0}};
  cap.mesh_W = sphere_mesh(0.006);
  for (Vec3& v : cap.mesh_W.vertices) v.z() += 0.006;
  made.softs.push_back(cap);
  const ShadedMesh lit = prepare_case(made).softs[0], unlit = prepare_unlit(made).softs[0];
  int rim = 0, thick = 0, between = 0;
  for (std::size_t k = 0; k < cap.mesh_W.vertices.size(); ++k) {
    const double height_m = cap.mesh_W.vertices[k].norm() - kBone_m;
    const int told = lit.shades[k].mottle;
    EXPECT_EQ(told, unlit.shades[k].mottle);
    if (height_m < -kSag_m) {
      EXPECT_EQ(told, 0);
      ++rim;
    }
    if (height_m > 0.00045 + kSag_m) {
      EXPECT_EQ(told, 128);
      ++thick;
    }
    if (height_m > kSag_m && height_m < 0.00045 - kSag_m) {
      EXPECT_NEAR(told, 128 * height_m / 0.00045, 128 * kSag_m / 0.00045);
      ++between;
    }
  }
  EXPECT_GT(rim, 10);
  EXPECT_GT(thick, 10);
  EXPECT_GT(between, 0);
}

TEST(PrepareCase, SameBytesEveryTime) {
  const PreparedCase a = prepare_case(pair_of_balls(0.001));
  const PreparedCase b = prepare_case(pair_of_balls(0.001));
  ASSERT_EQ(a.bones[1].shades.size(), b.bones[1].shades.size());
  EXPECT_EQ(std::memcmp(a.bones[1].shades.data(), b.bones[1].shades.data(),
                        a.bones[1].shades.size() * sizeof(ShadedMesh::Shade)),
            0);
  EXPECT_EQ(a.bones[1].positions, b.bones[1].positions);
}

TEST(PrepareCase, ProgressRisesToOneAndCanStop) {
  double last = -1;
  prepare_case(pair_of_balls(0.001), [&](double done) {
    EXPECT_GE(done, last);
    last = done;
    return true;
  });
  EXPECT_DOUBLE_EQ(last, 1);
  int calls = 0;
  const PreparedCase stopped = prepare_case(pair_of_balls(0.001), [&](double) {
    ++calls;
    return false;
  });
  EXPECT_EQ(calls, 1);
  EXPECT_FALSE(stopped.bones[1].triangles.empty());
  EXPECT_EQ(openness_towards(stopped.bones[1], -Vec3::UnitX()), 255);
}

}  // namespace
}  // namespace osteon
