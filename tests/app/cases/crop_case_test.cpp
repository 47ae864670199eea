#include "cases/crop_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/shapes.h"

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

}  // namespace
}  // namespace osteon
