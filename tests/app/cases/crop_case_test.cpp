#include "cases/crop_case.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "mesh/shapes.h"
#include "osteon/scene/bone_cover.h"
#include "osteon/scene/bone_pieces.h"
#include "osteon/scene/field_cache.h"
#include "osteon/scene/piece_cache.h"

namespace osteon {
namespace {

double volume_of(const TriMesh& mesh) {
  double six = 0;
  for (const Triangle& t : mesh.triangles)
    six += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six / 6;
}

bool is_closed(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      ++edges[{t[k], t[(k + 1) % 3]}];
      --edges[{t[(k + 1) % 3], t[k]}];
    }
  return std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; });
}

TEST(CropCase, ABallThatIsCutIsClosedAndFacesOutwards) {
  const TriMesh ball = test::sphere(1, 64);
  const TriMesh left = cut_off(ball, Vec3::UnitX(), 0.5);
  EXPECT_TRUE(is_closed(left));
  // A cap of height 0.5 is gone: pi h^2 (3 - h) / 3.
  EXPECT_NEAR(volume_of(ball) - volume_of(left), 0.6545, 0.01);
  for (const Vec3& v : left.vertices) EXPECT_LE(v.x(), 0.5 + 1e-12);
}

TEST(CropCase, APlaneBesideItLeavesAllOrNothing) {
  const TriMesh ball = test::sphere(1, 16);
  EXPECT_EQ(cut_off(ball, Vec3::UnitX(), 2).triangles.size(), ball.triangles.size());
  EXPECT_TRUE(cut_off(ball, Vec3::UnitX(), -2).triangles.empty());
}

TEST(CropCase, OnlyAGrownKneeIsCropped) {
  CaseDef def;
  def.name = "mine";
  EXPECT_FALSE(crop_knee(def, 0.1));
}

CaseDef balls(int count) {
  CaseDef def;
  for (int i = 0; i < count; ++i) {
    BoneDef bone;
    bone.name = "ball" + std::to_string(i);
    bone.felt = Felt::kField;
    bone.mesh = test::sphere(0.01 + 0.001 * i, 24);
    def.bones.push_back(std::move(bone));
  }
  return def;
}

// A field whose cells show that it was not made again.
TEST(CropCase, FieldsThatAFileHoldsAreNotMadeAgain) {
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("cropped_" + std::to_string(::getpid()) + ".bin");
  const CaseDef def = balls(8);
  constexpr double kMark_m = 0.00125;
  FieldOptions marked;
  marked.cell_m = kMark_m;
  {
    FieldCache kept(file);
    for (const BoneDef& bone : def.bones) {
      auto field = make_felt_field(bone, marked);
      ASSERT_TRUE(field) << field.error().message();
      kept.put(field_key(bone), std::make_shared<const DistanceField>(std::move(*field)));
    }
    ASSERT_TRUE(kept.save());
  }
  FieldCache fields(file);
  PieceCache pieces;
  prepare_cropped(def, pieces, fields);
  for (const BoneDef& bone : def.bones) {
    const auto field = fields.find(field_key(bone));
    ASSERT_TRUE(field) << bone.name;
    EXPECT_EQ(field->data().cell_m, kMark_m) << bone.name;
    EXPECT_NE(pieces.find(piece_key(bone.mesh)), nullptr) << bone.name;
  }
  std::filesystem::remove(file);
}

TEST(CropCase, FieldsThatNoFileHoldsAreMade) {
  const CaseDef def = balls(3);
  FieldCache fields;
  PieceCache pieces;
  prepare_cropped(def, pieces, fields);
  for (const BoneDef& bone : def.bones) {
    const auto field = fields.find(field_key(bone));
    ASSERT_TRUE(field) << bone.name;
    EXPECT_EQ(field->data().cell_m, 0.0005) << bone.name;
  }
}

}  // namespace
}  // namespace osteon
