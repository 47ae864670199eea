#include "osteon/mesh/append_mesh.h"

#include <gtest/gtest.h>

#include "osteon/mesh/measure.h"
#include "shapes.h"

namespace osteon {
namespace {

TEST(AppendMesh, NothingAddsNothing) {
  TriMesh mesh = test::sphere(0.005, 9);
  const TriMesh before = mesh;
  append_mesh(mesh, {});
  EXPECT_EQ(mesh.vertices.size(), before.vertices.size());
  EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(AppendMesh, BothAreThereAndApart) {
  const TriMesh one = test::sphere(0.005, 9), other = test::sphere(0.003, 9, Vec3(0.02, 0, 0));
  TriMesh both;
  append_mesh(both, one);
  append_mesh(both, other);
  const double sum_m3 = volume(one) + volume(other);
  EXPECT_NEAR(volume(both), sum_m3, 1e-12 * sum_m3);
  EXPECT_EQ(both.triangles.back()[0], other.triangles.back()[0] + one.vertices.size());
}

}  // namespace
}  // namespace osteon
