#include "cases/open_case.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "osteon/scene/case_io.h"

namespace osteon {
namespace {

namespace fs = std::filesystem;

/// A prism over an L: 30 mm by 30 mm by 10 mm, a quarter of it missing.
TriMesh angle() {
  TriMesh mesh;
  const double outline[6][2] = {{0, 0}, {30, 0}, {30, 15}, {15, 15}, {15, 30}, {0, 30}};
  for (const double z : {0.0, 10.0})
    for (const auto& at : outline) mesh.vertices.push_back(1e-3 * Vec3(at[0], at[1], z));
  const std::uint32_t face[4][3] = {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}};
  for (const auto& t : face) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, next + 6});
    mesh.triangles.push_back({k, next + 6, k + 6});
  }
  return mesh;
}

class OpenAtOnce : public ::testing::Test {
 protected:
  OpenAtOnce() {
    CaseDef def;
    def.name = "angles";
    for (const char* name : {"first", "second"}) {
      BoneDef bone;
      bone.name = name;
      bone.mesh = angle();
      bone.X_WB.p.z() = def.bones.empty() ? 0 : 0.1;
      def.bones.push_back(bone);
    }
    def.bones[1].felt = Felt::kHull;
    fs::create_directories(folder.parent_path());
    const auto saved = save_case(def, folder);
    EXPECT_TRUE(saved) << saved.error().message();
  }
  ~OpenAtOnce() override { fs::remove_all(folder); }
  fs::path folder = fs::temp_directory_path() / ("osteon_at_once_" + std::to_string(::getpid()));
};

TEST_F(OpenAtOnce, WhatIsNotThereIsNamed) {
  const auto opened = open_case_at_once((folder / "nowhere").string());
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message().find("nowhere"), std::string::npos);
}

TEST_F(OpenAtOnce, ABoneThatNoCacheKnowsIsFeltAsItsHullAndTheNameSaysSo) {
  const auto quick = open_case_at_once(folder.string());
  ASSERT_TRUE(quick) << quick.error().message();
  EXPECT_EQ(quick->finer, folder.string());
  EXPECT_EQ(quick->spec, folder.string() + "#first=hull");
  EXPECT_EQ(quick->the_case->bones[0].felt, Felt::kHull);
  EXPECT_EQ(quick->the_case->bones[0].pieces.size(), 1u);
  // A recording that names it is replayed on the very same case.
  const auto again = open_case(quick->spec);
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_EQ((*again)->hash, quick->the_case->hash);
}

TEST_F(OpenAtOnce, OnceItsPiecesAreKeptItIsFeltAsAskedFor) {
  const auto whole = open_case(folder.string());
  ASSERT_TRUE(whole) << whole.error().message();
  EXPECT_GT((*whole)->bones[0].pieces.size(), 1u);
  const auto quick = open_case_at_once(folder.string());
  ASSERT_TRUE(quick) << quick.error().message();
  EXPECT_TRUE(quick->finer.empty());
  EXPECT_EQ(quick->spec, folder.string());
  EXPECT_EQ(quick->the_case->hash, (*whole)->hash);
  // Another choice is unknown again: a field has not been made yet.
  const auto field = open_case_at_once(folder.string() + "#field");
  ASSERT_TRUE(field) << field.error().message();
  EXPECT_EQ(field->spec, folder.string() + "#hull");
  EXPECT_EQ(field->finer, folder.string() + "#field");
}

// Who touches no hull touches no piece: then the exchange cannot be felt.
TEST_F(OpenAtOnce, PiecesLieWithinTheHull) {
  const auto quick = open_case_at_once(folder.string());
  const auto whole = open_case(folder.string());
  ASSERT_TRUE(quick && whole);
  for (const Hull& piece : (*whole)->bones[0].pieces)
    for (const Vec3& p : piece.vertices)
      for (const Plane& plane : quick->the_case->bones[0].pieces[0].planes)
        EXPECT_LE(plane.n.dot(p) - plane.d, 1e-9);
}

TEST(OpenCase, NamesTheBuiltInCaseWhereNoFolderOfItsNameIs) {
  const auto plain = open_case_def(
      "/nowhere/knee", [](double) {}, CaseParts::kFelt);
  ASSERT_FALSE(plain);
  EXPECT_NE(plain.error().message().find("builtin:knee"), std::string::npos);
  const auto drawn = open_case_def(
      "wrist:7:left", [](double) {}, CaseParts::kFelt);
  ASSERT_FALSE(drawn);
  EXPECT_NE(drawn.error().message().find("builtin:wrist:7:left"), std::string::npos);
  const auto other = open_case_def(
      "/nowhere/hip", [](double) {}, CaseParts::kFelt);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().message().find("builtin"), std::string::npos);
}

}  // namespace
}  // namespace osteon
