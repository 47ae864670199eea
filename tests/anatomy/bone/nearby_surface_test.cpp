#include "bone/nearby_surface.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

TEST(NearbySurface, BoxDistanceIsNoughtInsideAndTheWayToTheBoxOutside) {
  const Aabb box{Vec3(-1, -2, -3), Vec3(1, 2, 3)};
  EXPECT_EQ(distance_to_box(Vec3(0.5, -2, 0), box), 0);
  EXPECT_EQ(distance_to_box(Vec3(3, 0, 0), box), 2);
  EXPECT_EQ(distance_to_box(Vec3(4, 6, 0), box), 5);
}

/// A walk over, into and far off a ball: each answer is the plain one, or none where that is right.
TEST(NearbySurface, AnswersLikeTheSurfaceOrSaysThatItIsFarther) {
  const MeshDistance ball(test::sphere(0.01, 24, Vec3(0.001, 0, 0)));
  NearbySurface nearby(ball, bounds(ball.mesh()));
  Random random(3);
  Vec3 p(0.02, 0, 0);
  int none = 0, some = 0;
  for (int i = 0; i < 4000; ++i) {
    p = 0.995 * (p + 0.0015 * random.direction());
    if (i % 400 == 399) p = 0.03 * random.direction();
    const double limit = random.uniform(-0.005, 0.01);
    const ClosestPoint plain = ball.closest(p);
    const auto at = nearby.nearer_than(limit, p);
    if (at) {
      ++some;
      EXPECT_EQ(at->signed_distance, plain.signed_distance);
      EXPECT_EQ(at->point, plain.point);
      EXPECT_EQ(at->triangle, plain.triangle);
    } else {
      ++none;
      EXPECT_GE(plain.signed_distance, limit);
    }
  }
  EXPECT_GT(none, 500);
  EXPECT_GT(some, 500);
}

}  // namespace
}  // namespace osteon
