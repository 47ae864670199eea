#include "surface/surface.h"

#include <gtest/gtest.h>

#include <limits>

#include "../scenes.h"

namespace osteon {
namespace {

TEST(Surface, EmptyMesh) {
  const Surface s = make_surface({});
  EXPECT_TRUE(s.points.empty());
  EXPECT_TRUE(mean_curvature(s).empty());
}

TEST(Surface, BrokenTrianglesAreLeftOut) {
  TriMesh mesh;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(nan, 0, 0)};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 99}, {0, 0, 1}};
  const Surface s = make_surface(mesh);
  EXPECT_EQ(s.triangles.size(), 1u);
  EXPECT_EQ(s.points.size(), 3u);
  for (const Vec3& n : s.normals) EXPECT_EQ(n, Vec3::UnitZ());
}

TEST(Surface, WeldsATriangleSoup) {
  const TriMesh whole = sphere_mesh(0.01);
  TriMesh soup;
  for (const Triangle& t : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t v : t) soup.vertices.push_back(whole.vertices[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const Surface s = make_surface(soup);
  EXPECT_EQ(s.points.size(), whole.vertices.size());
  EXPECT_EQ(s.triangles.size(), whole.triangles.size());
}

TEST(Surface, PointsKeepTheOrderOfTheirFirstUse) {
  TriMesh mesh;
  mesh.vertices = {Vec3(2, 0, 0), Vec3(0.0, 1, 0), Vec3(-0.0, 1, 0), Vec3(2, 0, 0), Vec3(1, 0, 0)};
  std::vector<std::uint32_t> place;
  const Surface s = welded(mesh, &place);
  EXPECT_EQ(place, (std::vector<std::uint32_t>{0, 1, 1, 0, 2}));
  ASSERT_EQ(s.points.size(), 3u);
  EXPECT_EQ(s.points[2], Vec3(1, 0, 0));
}

TEST(Surface, SphereHasRadialNormalsAndCurvatureOneOverRadius) {
  const double radius = 0.02;
  const Surface s = make_surface(sphere_mesh(radius));
  const std::vector<float> curvature = mean_curvature(s);
  for (std::size_t k = 0; k < s.points.size(); ++k) {
    EXPECT_GT(s.normals[k].dot(s.points[k].normalized()), 0.9999);
    EXPECT_NEAR(curvature[k], 1 / radius, 0.01 / radius);
  }
}

TEST(Surface, HollowsHaveNegativeCurvature) {
  TriMesh inside_out = sphere_mesh(0.02);
  for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  for (const float c : mean_curvature(make_surface(inside_out))) EXPECT_NEAR(c, -50, 0.5);
}

TEST(Surface, KnowsWhenItEnclosesAVolume) {
  TriMesh mesh = sphere_mesh(1);
  EXPECT_TRUE(encloses_volume(make_surface(mesh)));
  TriMesh inside_out = mesh;
  for (Triangle& t : inside_out.triangles) std::swap(t[1], t[2]);
  EXPECT_FALSE(encloses_volume(make_surface(inside_out)));
  TriMesh open = mesh;
  open.triangles.pop_back();
  EXPECT_FALSE(encloses_volume(make_surface(open)));
  TriMesh one_flipped = mesh;
  std::swap(one_flipped.triangles[7][0], one_flipped.triangles[7][1]);
  EXPECT_FALSE(encloses_volume(make_surface(one_flipped)));
  EXPECT_FALSE(encloses_volume(make_surface({})));
  TriMesh twice = mesh;
  twice.triangles.insert(twice.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  EXPECT_FALSE(encloses_volume(make_surface(twice)));
  TriMesh other_twice = mesh;  // its last triangle stands for the one before
  other_twice.triangles.back() = other_twice.triangles[other_twice.triangles.size() - 2];
  EXPECT_FALSE(encloses_volume(make_surface(other_twice)));
}

TEST(Surface, SmoothingKeepsConstantsAndShrinksSpikes) {
  const Surface s = make_surface(sphere_mesh(1));
  std::vector<float> flat(s.points.size(), 3.0f);
  smooth(s, 4, flat);
  for (const float v : flat) EXPECT_NEAR(v, 3, 1e-5);
  std::vector<float> spike(s.points.size(), 0.0f);
  spike[100] = 1;
  smooth(s, 2, spike);
  EXPECT_LT(spike[100], 0.4f);
  EXPECT_GT(spike[s.neighbours[s.first[100]]], 0.0f);
}

}  // namespace
}  // namespace osteon
