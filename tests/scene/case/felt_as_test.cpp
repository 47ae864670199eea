#include "osteon/scene/felt_as.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "osteon/scene/build_case.h"

namespace osteon {
namespace {

TriMesh cube_with_a_gap() {
  TriMesh mesh = test::cube(0.01);
  mesh.triangles.pop_back();
  return mesh;
}

CaseDef lone_bone(TriMesh mesh) {
  CaseDef def;
  def.bones.resize(1);
  def.bones[0].name = "lunate";
  def.bones[0].mesh = std::move(mesh);
  return def;
}

TEST(FeltAs, AnOpenMeshIsFeltAsItsHull) {
  EXPECT_EQ(felt_as(test::cube(0.01), Felt::kPieces), Felt::kPieces);
  EXPECT_EQ(felt_as(cube_with_a_gap(), Felt::kPieces), Felt::kHull);
  EXPECT_EQ(felt_as(cube_with_a_gap(), Felt::kField), Felt::kField);
}

TEST(FeltAs, ABuiltBoneSaysHowItIsFelt) {
  const auto closed = build_case(lone_bone(test::cube(0.01)));
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->bones[0].felt, Felt::kPieces);
  const auto open = build_case(lone_bone(cube_with_a_gap()));
  ASSERT_TRUE(open);
  EXPECT_EQ(open->bones[0].felt, Felt::kHull);
  EXPECT_EQ(open->bones[0].pieces.size(), 1u);
}

// A recording names its case by the hash: one that was made while such bones were called pieces
// still finds it.
TEST(FeltAs, TheHashKeepsWhatWasChosen) {
  CaseDef hull = lone_bone(cube_with_a_gap());
  hull.bones[0].felt = Felt::kHull;
  const auto as_pieces = build_case(lone_bone(cube_with_a_gap())),
             as_hull = build_case(std::move(hull));
  ASSERT_TRUE(as_pieces && as_hull);
  EXPECT_NE(as_pieces->hash, as_hull->hash);
}

}  // namespace
}  // namespace osteon
