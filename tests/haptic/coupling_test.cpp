#include "coupling.h"

#include <gtest/gtest.h>

#include <limits>

#include "osteon/base/random.h"
#include "osteon/scene/state.h"

namespace osteon {
namespace {

TEST(Coupling, SpringAndDamperAlongTheNormalAndInAllDirectionsWhenSticking) {
  Coupling c;
  c.stiffness_n_per_m = 1000;
  c.damping_n_s_per_m = 2;
  c.stretch_W = Vec3(0.0001, 0, 0.001);
  c.v_hand_W = Vec3(0.1, 0, -0.1);
  c.v_bone_W = Vec3(0, 0.05, 0);
  EXPECT_LT((coupling_force(c) - Vec3(0.1, 0, 1 + 0.2)).norm(), 1e-12);
  c.sticking = true;
  EXPECT_LT((coupling_force(c) - Vec3(0.1 - 0.2, 0.1, 1 + 0.2)).norm(), 1e-12);
}

TEST(Coupling, NeverPulls) {
  Coupling c;
  c.stiffness_n_per_m = 1000;
  c.damping_n_s_per_m = 20;
  c.stretch_W = Vec3(0, 0, 0.001);
  c.v_hand_W = Vec3(0, 0, 0.1);
  EXPECT_EQ(coupling_force(c), Vec3(Vec3::Zero()));
}

TEST(Coupling, TheSpringActsAlsoWhereTheProxyGlidesRoundAnEdge) {
  Coupling c;
  c.stiffness_n_per_m = 1000;
  c.stretch_W = Vec3(0.001, 0, -0.0002);  // against the new normal, but outside
  EXPECT_LT((coupling_force(c) - Vec3(1, 0, -0.2)).norm(), 1e-12);
  c.damping_n_s_per_m = 20;
  c.v_hand_W = Vec3(0, 0, -1);
  EXPECT_LT((coupling_force(c) - Vec3(1, 0, -0.2)).norm(), 1e-12);
  // Just before, the damper takes the part along the normal, but not the rest.
  c.stretch_W = Vec3(0.001, 0, 0.0002);
  c.v_hand_W = Vec3(0, 0, 1);
  EXPECT_LT((coupling_force(c) - Vec3(1, 0, 0)).norm(), 1e-12);
}

TEST(ForceLimits, HoldForEveryForceAndSayWhichActed) {
  Random random(23);
  Vec3 last = Vec3::Zero();
  for (int i = 0; i < 5000; ++i) {
    const double size = random.uniform(0, 12);
    const Vec3 wanted = size * random.direction();
    const double change = random.uniform(0, 4);
    std::uint32_t status = kTickOk;
    const Vec3 f = limited_force(wanted, last, {8, change}, status);
    ASSERT_LE(f.norm(), 8 + 1e-12);
    ASSERT_LE((f - last).norm(), change + 1e-12);
    ASSERT_EQ((status & kTickForceClamped) != 0, size > 8);
    if (!status) {
      ASSERT_EQ(f, wanted);
    }
    last = f;
  }
}

TEST(ForceLimits, NotFiniteIsZeroAtOnceAndALoweredLimitHolds) {
  std::uint32_t status = kTickOk;
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(limited_force(Vec3(inf, 0, 0), Vec3(5, 0, 0), {8, 0.1}, status), Vec3(Vec3::Zero()));
  EXPECT_EQ(status, kTickForceNotFinite);
  EXPECT_EQ(limited_force(Vec3(1e200, 0, 0), Vec3(5, 0, 0), {8, 0.1}, status), Vec3(Vec3::Zero()));
  status = kTickOk;
  EXPECT_NEAR(limited_force(Vec3(5, 0, 0), Vec3(5, 0, 0), {2, 0.1}, status).norm(), 2, 1e-12);
}

}  // namespace
}  // namespace osteon
