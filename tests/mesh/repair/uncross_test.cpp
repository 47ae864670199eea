#include "repair/uncross.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/self_crossing.h"

namespace osteon {
namespace {

TEST(Uncross, LeavesWhatDoesNotCrossAsItIs) {
  TriMesh mesh = test::sphere(0.01, 12);
  const auto before = mesh.vertices;
  std::vector<Vec3> home = before;
  for (Vec3& v : home) v *= 0.9;
  EXPECT_TRUE(uncross(mesh, home));
  EXPECT_EQ(mesh.vertices, before);
  TriMesh nothing;
  EXPECT_TRUE(uncross(nothing, {}));
}

TEST(Uncross, DrawsBackWhatWasPushedThroughTheOtherSideAndNoMore) {
  TriMesh mesh = test::sphere(0.01, 16);
  const std::vector<Vec3> home = mesh.vertices;
  const auto top = static_cast<std::size_t>(
      std::max_element(home.begin(), home.end(),
                       [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); }) -
      home.begin());
  mesh.vertices[top] = Vec3(0.0031, 0.0017, -0.02);
  ASSERT_FALSE(self_crossings(mesh).empty());
  EXPECT_TRUE(uncross(mesh, home));
  EXPECT_TRUE(self_crossings(mesh).empty());
  std::size_t moved = 0;
  for (std::size_t v = 0; v < home.size(); ++v) moved += (mesh.vertices[v] - home[v]).norm() > 1e-9;
  EXPECT_EQ(moved, 1u) << "the others came from where they are";
  EXPECT_LT(mesh.vertices[top].z(), home[top].z() - 1e-4) << "no farther back than needed";
}

/// What crossed from the beginning cannot be mended so, and is said.
TEST(Uncross, SaysWhenItCannot) {
  TriMesh mesh =
      test::joined(test::sphere(0.01, 8), test::sphere(0.01, 8, Vec3(0.011, 0.0003, 0.0002)));
  EXPECT_FALSE(uncross(mesh, mesh.vertices));
}

}  // namespace
}  // namespace osteon
