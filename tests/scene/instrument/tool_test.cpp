#include "osteon/scene/tool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "osteon/base/random.h"
#include "osteon/hull/validate.h"

namespace osteon {
namespace {

// How often each directed edge occurs.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges(const TriMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> out;
  for (const Triangle& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++out[{t[i], t[(i + 1) % 3]}];
  return out;
}

TEST(WristProbe, TipIsABallOf32CornersAboutTheOrigin) {
  for (const double r : {0.00075, 0.0005, 0.002}) {
    const Tool tool = make_wrist_probe(r);
    ASSERT_EQ(tool.pieces.size(), 1u);
    ASSERT_EQ(tool.bodies.size(), 1u);
    const Hull& tip = tool.pieces.front();
    EXPECT_EQ(tip.vertices.size(), 32u);
    EXPECT_EQ(tip.planes.size(), 60u);
    for (const Vec3& v : tip.vertices) EXPECT_NEAR(v.norm(), r, 1e-15);
    EXPECT_TRUE(validate_hull(tip, tip.vertices).empty());
    EXPECT_LT(tip.centroid.norm(), 1e-9 * r);
    EXPECT_EQ(tool.tip_radius_m, r);
  }
}

TEST(WristProbe, TipIsRoundWithinEightPercent) {
  const Tool tool = make_wrist_probe(0.00075);
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const double reach = support(tool.bodies.front(), random.direction());
    EXPECT_GT(reach, 0.92 * 0.00075);
    EXPECT_LE(reach, 0.00075 * (1 + 1e-12));
  }
}

TEST(WristProbe, DrawnMeshIsClosedOutwardAndStandsOnTheTip) {
  const Tool tool = make_wrist_probe();
  const auto directed = edges(tool.mesh);
  for (const auto& [edge, count] : directed) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(directed.count({edge.second, edge.first}));
  }
  double volume = 0;
  Aabb box;
  for (const Vec3& v : tool.mesh.vertices) box.include(v);
  for (const Triangle& t : tool.mesh.triangles)
    volume +=
        tool.mesh.vertices[t[0]].dot(tool.mesh.vertices[t[1]].cross(tool.mesh.vertices[t[2]])) / 6;
  EXPECT_GT(volume, 1e-6);  // outward: positive, and about that of the handle
  EXPECT_LT(volume, 1e-5);
  // Nothing of the hook reaches below the ball that is felt, and the shaft goes up along z.
  EXPECT_GE(box.lo.z(), -tool.tip_radius_m * (1 + 1e-12));
  EXPECT_NEAR(box.lo.z(), -tool.tip_radius_m, 0.02 * tool.tip_radius_m);
  EXPECT_GT(box.hi.z(), 0.15);
  EXPECT_LT(box.extent().x(), 0.015);
  for (const Triangle& t : tool.mesh.triangles) {
    const Vec3 a = tool.mesh.vertices[t[1]] - tool.mesh.vertices[t[0]];
    const Vec3 b = tool.mesh.vertices[t[2]] - tool.mesh.vertices[t[0]];
    ASSERT_GT(a.cross(b).norm(), 1e-14);  // no sliver that would break shading
  }
}

}  // namespace
}  // namespace osteon
