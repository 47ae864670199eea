// What of a soft solid's shape changes a picture.
#include "osteon/physics/soft_shape.h"

#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

SolidPushes on_top(double force_n) {
  SolidPushes pushes;
  pushes.count = 1;
  pushes.all[0].p_B = {0, 0, 0.040 + testing::kMeniscusHalf.z()};
  pushes.all[0].force_n = force_n;
  return pushes;
}

double lowest_way(const TriMesh& moved, const TriMesh& rest) {
  double lowest = 0;
  for (std::size_t v = 0; v < rest.vertices.size(); ++v)
    lowest = std::min(lowest, moved.vertices[v].z() - rest.vertices[v].z());
  return lowest;
}

TEST(SoftShapes, APushMovesTheSurfaceAndItsEndBringsItBack) {
  const testing::MeniscusRun& with = testing::meniscus_run();
  const TriMesh& rest = with.the_case->softs[0].mesh_W;
  SoftShapes shapes(*with.the_case, with.softs);
  EXPECT_TRUE(shapes.changes({}).empty());
  const auto pushed = shapes.changes(on_top(1));
  ASSERT_EQ(pushed.size(), 1u);
  EXPECT_EQ(pushed[0].soft, 0u);
  EXPECT_LT(lowest_way(pushed[0].mesh_W, rest), -1e-6);
  const auto back = shapes.changes({});
  ASSERT_EQ(back.size(), 1u);
  for (std::size_t v = 0; v < rest.vertices.size(); ++v)
    EXPECT_EQ(back[0].mesh_W.vertices[v], rest.vertices[v]);
}

// Small changes add up: each is compared with what was given last.
TEST(SoftShapes, WhatCannotBeSeenIsNotGivenAgain) {
  const testing::MeniscusRun& with = testing::meniscus_run();
  SoftShapes shapes(*with.the_case, with.softs);
  ASSERT_EQ(shapes.changes(on_top(1)).size(), 1u);
  EXPECT_TRUE(shapes.changes(on_top(1)).empty());
  EXPECT_TRUE(shapes.changes(on_top(1.003)).empty());
  EXPECT_EQ(shapes.changes(on_top(1.006)).size(), 1u);
}

TEST(SoftShapes, WithoutSoftPartsNothingChanges) {
  SoftShapes shapes(*testing::meniscus_run().the_case, nullptr);
  EXPECT_TRUE(shapes.changes(on_top(1)).empty());
}

}  // namespace
}  // namespace osteon
