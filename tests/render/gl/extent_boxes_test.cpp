#include "gl/extent_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "osteon/base/random.h"

namespace osteon {
namespace {

TEST(ExtentBoxes, OfNothingThereAreNone) {
  TriMesh mesh;
  EXPECT_TRUE(extent_boxes(mesh).empty());
  mesh.vertices.push_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(extent_boxes(mesh).empty());
  mesh.vertices.emplace_back(1, 2, 3);
  const auto one = extent_boxes(mesh);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].center, Vec3(1, 2, 3));
  EXPECT_EQ(one[0].half_m, Vec3(0, 0, 0));
}

TEST(ExtentBoxes, TheyHoldEveryVertexAndLieClose) {
  Random random(5);
  for (const Vec3& size : {Vec3(0.2, 0.03, 0.02), Vec3(0.02, 0.02, 0.02), Vec3(0, 0.1, 0)}) {
    TriMesh mesh;
    for (int k = 0; k < 3000; ++k) mesh.vertices.push_back(size.cwiseProduct(random.direction()));
    const auto boxes = extent_boxes(mesh);
    EXPECT_LE(boxes.size(), 512u);
    for (const Vec3& p : mesh.vertices)
      EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(), [&](const ExtentBox& box) {
        return ((p - box.center).cwiseAbs() - box.half_m).maxCoeff() <= 1e-12;
      }));
    const double cell_m = 2 * size.maxCoeff() / 8;
    for (const ExtentBox& box : boxes) EXPECT_LE(box.half_m.maxCoeff(), 0.5 * cell_m + 1e-12);
  }
}

}  // namespace
}  // namespace osteon
