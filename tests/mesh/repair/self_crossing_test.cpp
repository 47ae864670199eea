#include "osteon/mesh/self_crossing.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <set>

#include "mesh/shapes.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

TEST(SelfCrossing, NothingCrossesInSoundMeshes) {
  EXPECT_TRUE(self_crossings({}).empty());
  EXPECT_TRUE(self_crossings(test::cube()).empty());
  EXPECT_TRUE(self_crossings(test::sphere(1, 12)).empty());
  EXPECT_TRUE(self_crossings(test::soup(test::sphere(1, 12))).empty());
  TriMesh one;
  one.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  one.triangles = {{0, 1, 2}};
  EXPECT_TRUE(self_crossings(one).empty());
}

TEST(SelfCrossing, BoxesThatTouchDoNotCross) {
  const TriMesh stacked = test::joined(test::cube(0.5), test::cube(0.25, Vec3(0, 0, 0.75)));
  // Coplanar faces on each other overlap, which bounds no solid.
  EXPECT_FALSE(self_crossings(stacked).empty());
  TriMesh apart = test::joined(test::cube(0.5), test::cube(0.25, Vec3(0, 0, 0.7501)));
  EXPECT_TRUE(self_crossings(apart).empty());
}

// Each edge that pierces a face meets it on its diagonal: no edge goes through the inside of a
// triangle.
TEST(SelfCrossing, SeesBoxesThatMeetOnDiagonalsAlone) {
  for (const double shift : {0.45, 0.5, 0.3}) {
    const TriMesh boxes = test::joined(test::cube(0.5), test::cube(0.5, Vec3(shift, shift, shift)));
    EXPECT_FALSE(self_crossings(boxes).empty()) << shift;
  }
}

TEST(SelfCrossing, SeesAFoldAndAnEarThroughAFace) {
  TriMesh fold;
  fold.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.2, 1, 0), Vec3(0.8, 0.5, 0)};
  fold.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(self_crossings(fold), (std::vector<Pair>{{0, 1}}));
  fold.vertices[3].y() = -0.5;
  EXPECT_TRUE(self_crossings(fold).empty());
  TriMesh ear;  // the two share corner 0; the far edge of the second goes through the first
  ear.vertices = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0.5, 0.4, 1),
                  Vec3(0.5, 0.6, -1)};
  ear.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(self_crossings(ear), (std::vector<Pair>{{0, 1}}));
}

TEST(SelfCrossing, OfMarkedTrianglesOnly) {
  const TriMesh two = test::joined(test::sphere(1, 8), test::sphere(1, 8, Vec3(1.3, 0.02, 0.013)));
  const auto all = self_crossings(two);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(self_crossings(two, 3).size(), 3u);
  std::vector<bool> marked(two.triangles.size(), false);
  EXPECT_TRUE(self_crossings(two, marked).empty());
  std::fill(marked.begin(), marked.begin() + static_cast<long>(marked.size() / 2), true);
  EXPECT_EQ(self_crossings(two, marked), all);
}

// Oracle: CGAL's exact predicates over all pairs that share no corner (where sharing is touching).
TEST(SelfCrossing, AgreesWithExactPredicates) {
  Random random(23);
  TriMesh m;
  for (int i = 0; i < 120; ++i) {
    const Vec3 at = random.direction();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3 corner = random.direction();
      m.vertices.push_back(at + 0.4 * corner);
    }
    const auto first = static_cast<std::uint32_t>(3 * i);
    m.triangles.push_back({first, first + 1, first + 2});
  }
  const auto triangle = [&](std::uint32_t t) {
    const auto at = [&](std::size_t k) {
      const Vec3& v = m.vertices[m.triangles[t][k]];
      return Kernel::Point_3(v.x(), v.y(), v.z());
    };
    return Kernel::Triangle_3(at(0), at(1), at(2));
  };
  std::vector<Pair> wanted;
  for (std::uint32_t a = 0; a < m.triangles.size(); ++a)
    for (std::uint32_t b = a + 1; b < m.triangles.size(); ++b)
      if (CGAL::do_intersect(triangle(a), triangle(b))) wanted.emplace_back(a, b);
  ASSERT_GT(wanted.size(), 50u);
  EXPECT_EQ(self_crossings(m, 100000), wanted);
}

TEST(SelfCrossing, PartsThatOverlapAreToldFromOnePartThatCrossesItself) {
  const TriMesh one = test::cube(1);
  EXPECT_FALSE(crossing_parts({}));
  EXPECT_FALSE(crossing_parts(one));
  const TriMesh two = test::joined(one, test::cube(1, Vec3(1.1, 0.7, 0.3)));
  const auto found = crossing_parts(two);
  ASSERT_TRUE(found);
  EXPECT_LT(found->first, 12u);
  EXPECT_GE(found->second, 12u);
}

// A part that crosses itself more often than anybody lists them hides no overlap behind it.
TEST(SelfCrossing, PartsThatOverlapAreFoundAfterAnyNumberOfCrossings) {
  // Stars of triangles about one corner: all of a star pass through each other.
  TriMesh fan;
  fan.vertices = {Vec3::Zero()};
  for (int i = 0; i < 80; ++i) {
    const double turn = 0.01 * i;
    const auto first = static_cast<std::uint32_t>(fan.vertices.size());
    fan.vertices.emplace_back(1, -1, turn);
    fan.vertices.emplace_back(1, 1, 0.4 - turn);
    fan.triangles.push_back({0, first, first + 1});
  }
  ASSERT_EQ(self_crossings(fan).size(), kListedCrossings);
  EXPECT_FALSE(crossing_parts(fan));
  const TriMesh two =
      test::joined(test::cube(1, Vec3(3, 0, 0)), test::cube(1, Vec3(4.1, 0.7, 0.3)));
  const auto found = crossing_parts(test::joined(fan, two));
  ASSERT_TRUE(found);
  EXPECT_GE(found->first, 80u);
}

}  // namespace
}  // namespace osteon
