// What of a soft solid's shape changes a picture.
#include "osteon/physics/soft_shape.h"

#include "osteon/physics/soft_world.h"
#include "soft_fixtures.h"
#include "soft_solid_fixtures.h"

namespace osteon {
namespace {

SoftPushes on_top(double force_n) {
  SoftPushes pushes;
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

// A shaft bends a ligament in a session: its middle is where the string is, its ends stay.
TEST(SoftShapes, ALigamentBendsWhereTheShaftIsAndComesBack) {
  const testing::BandRun run;
  Session session = run.session();
  SoftShapes shapes(*run.the_case, run.softs);
  const auto press = [&](double deep_m) {
    const double z =
        session.tool_state().tick > 0 ? session.tool_state().X_WD.p.z() : testing::kTouch_m + 0.002;
    for (int n = 1; n <= 300; ++n)
      (void)session.tick(testing::shaft_at(z + n / 300.0 * (testing::kTouch_m - deep_m - z)));
  };
  press(-0.002);
  EXPECT_TRUE(shapes.changes(session.softs()->pushes()).empty());
  press(0.004);
  const SoftPushes pushes = session.softs()->pushes();
  ASSERT_EQ(pushes.bend_count, 1u);
  EXPECT_NEAR(pushes.bends[0].share, 0.5, 1e-6);
  EXPECT_NEAR(pushes.bends[0].bent_m + pushes.bends[0].dent_m, 0.004, 1e-4);
  const auto bent = shapes.changes(pushes);
  ASSERT_EQ(bent.size(), 1u);
  const TriMesh& rest = run.the_case->softs[0].mesh_W;
  for (std::size_t v = 0; v < rest.vertices.size(); ++v)  // a box: all its corners are at its ends
    EXPECT_LT((bent[0].mesh_W.vertices[v] - rest.vertices[v]).norm(), 1e-9);
  press(-0.002);
  EXPECT_EQ(shapes.changes(session.softs()->pushes()).size(), 1u);
  EXPECT_EQ(session.softs()->pushes().bend_count, 0u);
}

}  // namespace
}  // namespace osteon
