#include "bone/placed_bones.h"

#include <gtest/gtest.h>

#include "bone/overlap.h"
#include "mesh/shapes.h"

namespace osteon {
namespace {

/// Two balls of 10 mm, the second 17 mm along x and turned, so that they overlap by 3 mm.
GeneratedAnatomy two_balls() {
  GeneratedAnatomy grown;
  for (const char* const name : {"a", "b"}) {
    GeneratedBone ball;
    ball.name = name;
    ball.mesh = test::sphere(0.01, 24, Vec3::Zero());
    grown.bones.push_back(ball);
  }
  grown.bones[1].X_WB = {Vec3(0.017, 0, 0), Quat(0, 0, 0, 1)};
  return grown;
}

TEST(PlacedBones, StandWhereTheyAreAndAreGivenAwayOnce) {
  const GeneratedAnatomy grown = two_balls();
  PlacedBones placed(grown, {});
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_NEAR(placed.surface_W(1).closest(Vec3(0.03, 0, 0)).signed_distance, 0.003, 1e-4);
  EXPECT_FALSE(placed.take(1, {})) << "it stands elsewhere";
  EXPECT_FALSE(placed.take(1, {Vec3(0.017, 0, 0), Quat(1, 0, 0, 0)})) << "it is turned";
  EXPECT_TRUE(placed.take(1, grown.bones[1].X_WB));
  EXPECT_FALSE(placed.take(1, grown.bones[1].X_WB)) << "twice";
  EXPECT_FALSE(placed.take(2, {})) << "there is none";
  EXPECT_FALSE(PlacedBones().take(0, {}));
}

TEST(PlacedBones, TheirDeepestOverlapIsTheSameHoweverTasksAreRun) {
  const GeneratedAnatomy grown = two_balls();
  GenerateOptions backwards;
  backwards.run = [](std::size_t count, const std::function<void(std::size_t)>& task,
                     const std::function<void(double)>&) {
    while (count > 0) task(--count);
  };
  const Overlap plain = deepest_overlap(grown, PlacedBones(grown, {}), {});
  const Overlap other = deepest_overlap(grown, PlacedBones(grown, backwards), backwards);
  EXPECT_NEAR(plain.depth, 0.003, 1e-4);
  EXPECT_EQ(plain.bone, "a");
  EXPECT_EQ(plain.other, "b");
  EXPECT_EQ(other.depth, plain.depth);
  GeneratedAnatomy apart = grown;
  apart.bones[1].X_WB.p.x() = 0.03;
  EXPECT_EQ(deepest_overlap(apart, PlacedBones(apart, {}), {}).depth, 0);
}

}  // namespace
}  // namespace osteon
