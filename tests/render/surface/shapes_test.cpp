#include "surface/shapes.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "../scenes.h"

namespace osteon {
namespace {

/// Divergence theorem.
double enclosed_volume(const TriMesh& mesh) {
  double six_volumes = 0;
  for (const Triangle& t : mesh.triangles)
    six_volumes += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return six_volumes / 6;
}

bool is_closed(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (count != 1 || back == edges.end() || back->second != 1) return false;
  }
  return true;
}

TEST(Shapes, MarksAreClosedAndFaceOutwards) {
  const double pi = std::numbers::pi;
  EXPECT_TRUE(is_closed(cylinder(60)));
  EXPECT_NEAR(enclosed_volume(cylinder(60)), pi, 0.01);
  EXPECT_TRUE(is_closed(cone(60)));
  EXPECT_NEAR(enclosed_volume(cone(60)), pi / 3, 0.01);
  EXPECT_TRUE(is_closed(ball(40, 60)));
  EXPECT_NEAR(enclosed_volume(ball(40, 60)), 4 * pi / 3, 0.03);
}

TEST(Shapes, EdgesOfACubeAreTwelveWithoutDiagonals) {
  const Hull cube = cube_hull(0.5);
  const auto ends = facet_edges({&cube, 1});
  ASSERT_EQ(ends.size(), 24u);
  for (std::size_t k = 0; k < ends.size(); k += 2) {
    int differing = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (ends[k][axis] != ends[k + 1][axis]) ++differing;
    EXPECT_EQ(differing, 1);
  }
}

TEST(Shapes, FacetsHaveTheirPlanesNormal) {
  const Hull cube = cube_hull(0.5);
  const ShadedMesh mesh = faceted({&cube, 1});
  ASSERT_EQ(mesh.triangles.size(), 12u);
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    double height = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      height += static_cast<double>(mesh.positions[k][axis] * mesh.normals[k][axis]);
    EXPECT_NEAR(height, 0.5, 1e-6);
  }
  EXPECT_TRUE(facet_edges({}).empty());
}

TEST(Shapes, PlainShadingKeepsSharpEdgesAndSmoothsRoundOnes) {
  const Hull cube = cube_hull(1);
  TriMesh box{cube.vertices, cube.triangles};
  const ShadedMesh sharp = plain_shaded(box);
  ASSERT_FALSE(sharp.normals.empty());
  for (const auto& n : sharp.normals)
    EXPECT_NEAR(std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]), 1, 1e-6);
  const ShadedMesh round = plain_shaded(sphere_mesh(1));
  for (std::size_t k = 0; k < round.normals.size(); ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(round.normals[k][axis], round.positions[k][axis], 0.02);
}

}  // namespace
}  // namespace osteon
