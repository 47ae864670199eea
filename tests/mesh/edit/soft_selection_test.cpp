#include "osteon/mesh/soft_selection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "mesh/shapes.h"
#include "mesh/solids.h"

namespace osteon {
namespace {

std::map<std::uint32_t, SoftWeight> by_vertex(const std::vector<SoftWeight>& selected) {
  std::map<std::uint32_t, SoftWeight> out;
  for (const SoftWeight& s : selected) out[s.vertex] = s;
  return out;
}

/// A square sheet of n x n cells of side `cell`, each cut along the same diagonal.
TriMesh sheet(std::uint32_t n, double cell) {
  TriMesh m;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) m.vertices.push_back(cell * Vec3(x, y, 0));
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
      m.triangles.push_back({a, a + 1, b + 1});
      m.triangles.push_back({a, b + 1, b});
    }
  return m;
}

TEST(SoftSelection, AVertexAloneIsSelectedAlone) {
  TriMesh m = test::cube();
  m.vertices.emplace_back(9, 9, 9);  // of no triangle
  const SurfaceWalk walk(m);
  const auto lone = walk.select(m, 8, {});
  ASSERT_EQ(lone.size(), 1u);
  EXPECT_EQ(lone[0].weight, 1);
  EXPECT_EQ(walk.select(m, 0, {1e-6, FallOff::kCone}).size(), 1u);
  EXPECT_EQ(walk.select(m, 0, {0, FallOff::kCone}).size(), 1u);
}

TEST(SoftSelection, TrianglesWithoutAreaDoNotStopTheFront) {
  TriMesh m = sheet(4, 1);
  m.vertices[7] = m.vertices[6];
  const auto selected = SurfaceWalk(m).select(m, 0, {10, FallOff::kCone});
  EXPECT_EQ(selected.size(), m.vertices.size());
  for (const SoftWeight& s : selected) EXPECT_TRUE(std::isfinite(s.distance_m));
}

// Closed form: straight lines.
TEST(SoftSelection, DistancesOnASheetAreStraight) {
  const TriMesh m = sheet(20, 0.001);
  const std::uint32_t middle = 10 * 21 + 10;
  const auto selected = by_vertex(SurfaceWalk(m).select(m, middle, {0.009, FallOff::kCone}));
  for (std::uint32_t v = 0; v < m.vertices.size(); ++v) {
    const double straight = (m.vertices[v] - m.vertices[middle]).norm();
    const auto found = selected.find(v);
    if (straight < 0.0088) {
      ASSERT_NE(found, selected.end()) << v;
      EXPECT_NEAR(found->second.distance_m, straight, 0.01 * straight) << v;
      EXPECT_NEAR(found->second.weight, 1 - found->second.distance_m / 0.009, 1e-12);
    }
    if (straight > 0.009) {
      EXPECT_EQ(found, selected.end()) << v;
    }
  }
}

// Closed form: great circles.
TEST(SoftSelection, DistancesOnABallAreGreatCircles) {
  const TriMesh m = test::sphere(0.01, 40);
  const std::uint32_t grabbed = 1 + 19 * 80;  // on the equator
  const auto selected = SurfaceWalk(m).select(m, grabbed, {0.02, FallOff::kSmooth});
  ASSERT_GT(selected.size(), 500u);
  double last = 0;
  for (const SoftWeight& s : selected) {
    const double cosine = m.vertices[s.vertex].dot(m.vertices[grabbed]) / 1e-4;
    const double arc = 0.01 * std::acos(std::clamp(cosine, -1.0, 1.0));
    EXPECT_NEAR(s.distance_m, arc, 0.02 * arc + 1e-9);
    EXPECT_GE(s.distance_m, last);
    last = s.distance_m;
  }
}

// A vertex 0.8 mm away through the part lies 10 mm away around its rim.
TEST(SoftSelection, TheOtherSideOfAThinPartIsFar) {
  TriMesh top = sheet(20, 0.001), bottom = sheet(20, 0.001);
  for (Vec3& v : top.vertices) v.z() = 0.0008;
  for (Triangle& t : bottom.triangles) test::flip(t);
  TriMesh plate = test::joined(top, bottom);
  const std::uint32_t below = 21 * 21, middle = 10 * 21 + 10;
  for (std::uint32_t i = 0; i < 20; ++i)  // one wall joins them
    for (const Triangle& t :
         {Triangle{i, below + i, below + i + 1}, Triangle{i, below + i + 1, i + 1}})
      plate.triangles.push_back(t);
  const SurfaceWalk walk(plate);
  for (const SoftWeight& s : walk.select(plate, middle, {0.009, FallOff::kDome}))
    EXPECT_LT(s.vertex, below);
  const auto far = by_vertex(walk.select(plate, middle, {0.025, FallOff::kDome}));
  ASSERT_TRUE(far.contains(below + middle));
  EXPECT_NEAR(far.at(below + middle).distance_m, 0.0208, 0.0003);
}

TEST(SoftSelection, FallOffsRunFromOneToNothing) {
  for (const FallOff f : {FallOff::kSmooth, FallOff::kCone, FallOff::kDome, FallOff::kSpike}) {
    EXPECT_EQ(fall_off_from_text(to_text(f)), f);
    EXPECT_EQ(fall_off_weight(f, 0), 1);
    EXPECT_EQ(fall_off_weight(f, 1), 0);
    EXPECT_EQ(fall_off_weight(f, 7), 0);
    double last = 1;
    for (int i = 1; i <= 100; ++i) {
      const double weight = fall_off_weight(f, i / 100.0);
      EXPECT_LT(weight, last);
      last = weight;
    }
  }
  EXPECT_NEAR(fall_off_weight(FallOff::kSmooth, 0.5), 0.5, 1e-15);
  EXPECT_NEAR(fall_off_weight(FallOff::kDome, 0.6), 0.8, 1e-15);
  EXPECT_NEAR(fall_off_weight(FallOff::kSpike, 0.5), 0.25, 1e-15);
  EXPECT_FALSE(fall_off_from_text("bubble"));
}

}  // namespace
}  // namespace osteon
