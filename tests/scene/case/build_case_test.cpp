#include "osteon/scene/build_case.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../../mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/measure.h"
#include "osteon/scene/bone_names.h"
#include "osteon/scene/piece_cache.h"
#include "osteon/scene/state.h"

namespace osteon {
namespace {

CaseDef two_bones() {
  CaseDef def;
  def.name = "two";
  def.side = "left";
  BoneDef bone;
  bone.name = "lunate";
  bone.fma_id = 23712;
  bone.mesh = test::sphere(0.008, 8);
  bone.X_WB.p = Vec3(0.01, 0.02, 0.03);
  def.bones.push_back(bone);
  bone.name = "cube";
  bone.fma_id = 0;
  bone.mesh = test::cube(0.005);
  bone.X_WB = {Vec3(0, 0, -0.1), Quat(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitZ()))};
  def.bones.push_back(bone);
  def.landmarks = {{"centre", Vec3(0.01, 0.02, 0.03)}};
  return def;
}

std::string error_of(CaseDef def) {
  const auto result = build_case(std::move(def));
  return result ? "" : result.error().message();
}

TEST(BuildCase, RefusesWhatCannotBeSimulated) {
  const auto spoiled = [](auto spoil) {
    CaseDef def = two_bones();
    spoil(def);
    return error_of(def);
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const double nan = std::nan("");
  EXPECT_TRUE(has(spoiled([](CaseDef& d) { d.bones.clear(); }), "no bones"));
  EXPECT_TRUE(
      has(spoiled([](CaseDef& d) { d.bones.resize(kMaxBones + 1, d.bones[0]); }), "65 bones"));
  EXPECT_TRUE(has(spoiled([](CaseDef& d) { d.bones[1].name = "lunate"; }), "two bones"));
  EXPECT_TRUE(has(spoiled([](CaseDef& d) { d.bones[1].name = ""; }), "no name"));
  EXPECT_TRUE(has(spoiled([](CaseDef& d) { d.bones[1].mesh = {}; }), "bone 'cube'"));
  EXPECT_TRUE(has(spoiled([](CaseDef& d) {
                    for (Vec3& v : d.bones[1].mesh.vertices) v.z() = 0;
                  }),
                  "bone 'cube'"));
  EXPECT_TRUE(has(spoiled([&](CaseDef& d) { d.bones[1].mesh.vertices[3].x() = nan; }), "cube"));
  EXPECT_TRUE(
      has(spoiled([](CaseDef& d) { d.bones[1].mesh.triangles[3][1] = 99; }), "does not exist"));
  EXPECT_TRUE(has(spoiled([&](CaseDef& d) { d.bones[0].X_WB.p.x() = nan; }), "pose"));
  EXPECT_TRUE(has(spoiled([](CaseDef& d) { d.bones[0].X_WB.q.w() = 2; }), "pose"));
  EXPECT_TRUE(has(spoiled([](CaseDef& d) { d.bones[0].density_kg_per_m3 = 0; }), "density"));
  EXPECT_TRUE(
      has(spoiled([](CaseDef& d) { d.bones[0].material.dynamic_friction = 0.5; }), "material"));
  EXPECT_TRUE(has(spoiled([&](CaseDef& d) { d.landmarks[0].p_W.y() = nan; }), "landmark"));
  EXPECT_EQ(error_of(two_bones()), "");
}

TEST(BuildCase, MakesHullsBodiesAndMasses) {
  const auto built = build_case(two_bones());
  ASSERT_TRUE(built) << built.error().message();
  ASSERT_EQ(built->bones.size(), 2u);
  for (const Bone& bone : built->bones) {
    ASSERT_EQ(bone.pieces.size(), bone.bodies.size());
    ASSERT_EQ(bone.pieces.size(), 1u);
    EXPECT_EQ(bone.pieces[0].vertices.size(), bone.mesh.vertices.size());
    EXPECT_EQ(bone.bodies[0].vertex_count, bone.mesh.vertices.size());
  }
  EXPECT_NEAR(built->bones[1].mass_kg, 1e-6 * 1900, 1e-12);
  EXPECT_NEAR(built->bones[0].mass_kg, volume(built->bones[0].mesh) * 1900, 1e-12);
}

TEST(BuildCase, AnOpenBoneWeighsWhatItsHullWeighs) {
  CaseDef def = two_bones();
  def.bones[1].mesh.triangles.resize(6);
  const auto built = build_case(def);
  ASSERT_TRUE(built);
  EXPECT_NEAR(built->bones[1].mass_kg, 1e-6 * 1900, 1e-12);
}

TEST(BuildCase, FindsBonesAndTheirBounds) {
  const auto built = build_case(two_bones());
  ASSERT_TRUE(built);
  EXPECT_EQ(built->find("cube").index, 1u);
  EXPECT_EQ(built->bone(built->find("lunate")).fma_id, 23712);
  EXPECT_FALSE(built->find("femur").valid());
  EXPECT_FALSE(built->find("").valid());
  const Aabb box = built->bounds_W();
  EXPECT_NEAR(box.lo.z(), -0.105, 1e-12);
  EXPECT_NEAR(box.lo.x(), -0.005 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(box.hi.z(), 0.038, 1e-12);
}

TEST(BuildCase, TheHashSeesEverythingThatIsFeltAndNothingElse) {
  const std::uint64_t plain = build_case(two_bones())->hash;
  EXPECT_EQ(build_case(two_bones())->hash, plain);
  const auto changed = [&](auto change) {
    CaseDef def = two_bones();
    change(def);
    const auto built = build_case(def);
    return built && built->hash != plain;
  };
  const double up = 1 + 4 * std::numeric_limits<double>::epsilon();
  EXPECT_TRUE(changed([&](CaseDef& d) { d.bones[0].X_WB.p.x() *= up; }));
  EXPECT_TRUE(changed([&](CaseDef& d) { d.bones[1].X_WB.q = Quat::Identity(); }));
  EXPECT_TRUE(changed([&](CaseDef& d) { d.bones[0].mesh.vertices[7].y() *= up; }));
  EXPECT_TRUE(changed(
      [&](CaseDef& d) { std::swap(d.bones[0].mesh.triangles[0], d.bones[0].mesh.triangles[1]); }));
  EXPECT_TRUE(changed([&](CaseDef& d) { d.bones[0].density_kg_per_m3 += 1; }));
  EXPECT_TRUE(changed([&](CaseDef& d) { d.bones[0].material.stiffness_n_per_m += 1; }));
  EXPECT_TRUE(changed([&](CaseDef& d) { d.bones[0].material.static_friction += 0.01; }));
  EXPECT_TRUE(changed([&](CaseDef& d) { d.bones[0].material.dynamic_friction += 0.01; }));
  EXPECT_TRUE(changed([&](CaseDef& d) { d.bones[0].name = "lunatum"; }));
  EXPECT_FALSE(changed([&](CaseDef& d) { d.landmarks[0].p_W.z() *= up; }));
  EXPECT_TRUE(changed([&](CaseDef& d) { std::swap(d.bones[0], d.bones[1]); }));
  EXPECT_FALSE(changed([&](CaseDef& d) { d.name = "renamed"; }));
}

// A corner of three bars: its hull is far from it.
TriMesh corner_mesh() {
  const auto field = [](const Vec3& p) {
    const Vec3 q = p - Vec3::Constant(0.004);
    return std::max(p.cwiseAbs().maxCoeff() - 0.008, q.minCoeff() > 0 ? q.minCoeff() : -1e-3);
  };
  IsosurfaceOptions options;
  options.cell_m = 0.001;
  return isosurface(field, {Vec3::Constant(-0.01), Vec3::Constant(0.01)}, options).value();
}

TEST(BuildCase, FeelsPiecesOrTheHullAsTold) {
  CaseDef def;
  def.bones.resize(1);
  def.bones[0].name = "corner";
  def.bones[0].mesh = corner_mesh();
  PieceCache cache;
  BuildOptions options;
  options.pieces = &cache;
  std::size_t told = 0;
  options.progress = [&](std::size_t, std::size_t count) { told += count; };
  const auto fresh = build_case(def, options);
  const auto cached = build_case(def, options);
  ASSERT_TRUE(fresh && cached);
  EXPECT_EQ(told, 2u);
  EXPECT_GT(fresh->bones[0].pieces.size(), 1u);
  EXPECT_EQ(fresh->hash, cached->hash);
  EXPECT_EQ(fresh->hash, build_case(def)->hash);
  def.bones[0].felt = Felt::kHull;
  const auto hull = build_case(def, options);
  ASSERT_TRUE(hull);
  EXPECT_EQ(hull->bones[0].pieces.size(), 1u);
  EXPECT_NE(hull->hash, fresh->hash);
}

TEST(BuildCase, FeltHasANameEach) {
  for (const Felt felt : {Felt::kPieces, Felt::kHull, Felt::kField})
    EXPECT_EQ(felt_from_text(to_text(felt)), felt);
  EXPECT_FALSE(felt_from_text("grid"));
}

TEST(State, RestIsWhereTheCasePutsTheBones) {
  const auto built = build_case(two_bones());
  ASSERT_TRUE(built);
  const BoneSnapshot rest = rest_snapshot(*built);
  EXPECT_EQ(rest.count, 2u);
  EXPECT_EQ(rest.step, 0u);
  EXPECT_EQ(rest.bones[1].X_WB.p, built->bones[1].X_WB.p);
  EXPECT_EQ(rest.bones[1].v_W, Vec3(0, 0, 0));
  EXPECT_EQ(rest_snapshot(Case{}).count, 0u);
}

TEST(BoneNames, EveryKnownNameIsItsOwnAndHasANumber) {
  const std::vector<std::string> names = known_bone_names();
  EXPECT_GT(names.size(), 15u);
  for (const std::string& name : names) {
    EXPECT_EQ(canonical_bone_name(name), name);
    EXPECT_GT(fma_id_of(name), 0) << name;
  }
}

TEST(BoneNames, KnowFilesAndFmaIds) {
  EXPECT_EQ(canonical_bone_name("1mc"), "metacarpal_1");
  EXPECT_EQ(canonical_bone_name("5MC"), "metacarpal_5");
  EXPECT_EQ(canonical_bone_name("Metacarpal 3"), "metacarpal_3");
  EXPECT_EQ(canonical_bone_name("lumbar4"), "lumbar_4");
  EXPECT_EQ(canonical_bone_name("Scaphoid"), "scaphoid");
  EXPECT_EQ(canonical_bone_name("my_bone"), "my_bone");
  EXPECT_EQ(canonical_bone_name(""), "");
  EXPECT_EQ(fma_id_of("1mc"), 23899);
  EXPECT_EQ(fma_id_of("metacarpal_5"), 23903);
  EXPECT_EQ(fma_id_of("radius"), 23463);
  EXPECT_EQ(fma_id_of("femur"), 9611);
  EXPECT_EQ(fma_id_of("L5"), 13076);
  EXPECT_EQ(fma_id_of("my_bone"), 0);
  EXPECT_EQ(fma_id_of(""), 0);
}

}  // namespace
}  // namespace osteon
