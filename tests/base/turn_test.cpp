#include "osteon/base/turn.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

TEST(Turn, BetweenOppositeDirectionsIsAHalfTurn) {
  Random r(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 from = r.direction();
    const Quat q = turn_between(from, -from);
    EXPECT_LT((q * from + from).norm(), 1e-12);
    EXPECT_LT(std::abs(q.w()), 1e-12);
    EXPECT_NEAR(q.norm(), 1, 1e-14);
  }
}

TEST(Turn, BetweenEqualDirectionsIsNone) {
  const Vec3 v(1, -2, 0.5);
  EXPECT_LT(turn_between(v, 3 * v).vec().norm(), 1e-15);
}

TEST(Turn, TakesOneDirectionToTheOtherByTheLeastAngle) {
  Random r(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3 from = r.direction(), to = r.direction();
    const Quat q = turn_between(0.01 * from, 7 * to);
    EXPECT_LT((q * from - to).norm(), 1e-12);
    EXPECT_NEAR(q.angularDistance(Quat::Identity()), std::acos(from.dot(to)), 1e-7);
  }
}

}  // namespace
}  // namespace osteon
