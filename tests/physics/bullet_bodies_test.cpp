#include "bullet_bodies.h"

#include <gtest/gtest.h>

#include "osteon/base/random.h"

namespace osteon {
namespace {

MassProperties some_mass() {
  MassProperties mass;
  mass.mass_kg = 0.003;
  mass.moments = {1e-7, 2e-7, 3e-7};
  return mass;
}

TEST(BulletBodies, MoveByTheirVelocities) {
  Random random(8);
  BulletBodies bodies;
  for (int i = 0; i < 20; ++i) bodies.add(some_mass(), Vec3::Constant(0.01));
  for (std::size_t i = 0; i < 20; ++i) {
    const Pose X_WI{random.direction(), random.rotation()};
    const Vec3 v_W = random.direction();
    const Vec3 w_W = random.direction() * random.uniform(0, 50);
    bodies.set(i, X_WI, v_W, w_W);
    bodies.advance(0.002);
    const Pose moved = bodies.pose(i);
    const double angle = w_W.norm() * 0.002;
    const Quat turn(Eigen::AngleAxisd(angle, w_W.normalized()));
    EXPECT_LT((moved.p - (X_WI.p + 0.002 * v_W)).norm(), 1e-15);
    EXPECT_LT((turn * X_WI.q).angularDistance(moved.q), 1e-7);
    bodies.set(i, X_WI, Vec3::Zero(), Vec3::Zero());
  }
}

TEST(BulletBodies, NeitherFallNorCollide) {
  BulletBodies bodies;
  for (int i = 0; i < 3; ++i) bodies.add(some_mass(), Vec3::Constant(0.01));  // all in one place
  for (int i = 0; i < 1000; ++i) bodies.advance(0.002);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(bodies.pose(i).p, Vec3::Zero());
    EXPECT_EQ(bodies.pose(i).q.coeffs(), Quat::Identity().coeffs());
  }
}

}  // namespace
}  // namespace osteon
