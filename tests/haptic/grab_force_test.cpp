#include "grab_force.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/haptic/haptic.h"
#include "test_scene.h"

namespace osteon {
namespace {

constexpr double kStiffness = 150;

/// A block of 20 mm about the origin and a small ball-like probe.
class Grab : public ::testing::Test {
 protected:
  static std::shared_ptr<const Case> block() {
    Case c;
    c.bones.push_back(test::bone_of({test::box_hull(Vec3::Constant(0.01))}));
    return std::make_shared<const Case>(std::move(c));
  }
  static std::shared_ptr<const Tool> probe() {
    return std::make_shared<const Tool>(test::tool_of(test::box_hull(Vec3::Constant(0.0005))));
  }
  const ToolState& at(const Vec3& p_W, const Vec3& v_W = Vec3::Zero()) {
    ToolInput input;
    input.X_WD.p = p_W;
    input.v_W = v_W;
    return loop.tick(input, rest_snapshot(*scene), 0, params);
  }
  const ToolState& rest_at(const Vec3& p_W) {
    for (int i = 0; i < 50; ++i) at(p_W);
    return at(p_W);
  }

  std::shared_ptr<const Case> scene = block();
  HapticLoop loop{scene, probe()};
  HapticParams params;
};

TEST(GrabForce, IsASpringAndADamper) {
  EXPECT_EQ(grab_force(Vec3::Zero(), Vec3::Zero(), 150, 2), Vec3(0, 0, 0));
  const Vec3 force = grab_force(Vec3(0.01, 0, -0.02), Vec3(0, 0.1, 0), 150, 2);
  EXPECT_NEAR((force - Vec3(-1.5, -0.2, 3)).norm(), 0, 1e-15);
}

// The magnitude is in proportion to the displacement, from wherever the hand was at the grab.
TEST_F(Grab, ResistsInProportionToTheDisplacement) {
  const Vec3 from(0.03, 0.01, 0.02);
  rest_at(from);
  params.grab_n_per_m = kStiffness;
  EXPECT_EQ(rest_at(from).force_W.norm(), 0);
  EXPECT_NE(at(from).status & kTickGrabbing, 0u);
  const Vec3 way = Vec3(1, -2, 2) / 3;
  for (const double far : {0.002, 0.004, 0.012}) {
    const ToolState& tool = rest_at(from + far * way);
    EXPECT_NEAR((tool.force_W + kStiffness * far * way).norm(), 0, 1e-12) << far;
  }
}

// It may be dragged through bone, which it does not feel; afterwards nothing kicks.
TEST_F(Grab, TouchesNothingWhileItDrags) {
  rest_at(Vec3(0, 0, 0.02));
  params.grab_n_per_m = kStiffness;
  rest_at(Vec3(0, 0, 0.02));
  const ToolState& inside = rest_at(Vec3(0, 0, 0.002));
  EXPECT_EQ(inside.contact_count, 0u);
  EXPECT_NEAR((inside.force_W - Vec3(0, 0, kStiffness * 0.018)).norm(), 0, 1e-12);
  EXPECT_EQ(inside.X_WP.p, Vec3(0, 0, 0.002));
  params.grab_n_per_m = 0;
  EXPECT_EQ(at(Vec3(0, 0, 0.002)).force_W.norm(), 0);
  EXPECT_EQ(at(Vec3(0, 0, 0.002)).status & kTickGrabbing, 0u);
  EXPECT_EQ(rest_at(Vec3(0, 0, 0.002)).force_W.norm(), 0);  // not until it has been free
  rest_at(Vec3(0, 0, 0.02));
  EXPECT_GT(rest_at(Vec3(0, 0, 0.0101)).force_W.z(), 0.1);
}

TEST_F(Grab, KeepsToTheLimitsOfTheDevice) {
  rest_at(Vec3(0, 0, 0.02));
  params.grab_n_per_m = 1000;
  at(Vec3(0, 0, 0.02));
  const ToolState& jumped = at(Vec3(0, 0, 0.5));
  EXPECT_LE(jumped.force_W.norm(), params.max_slew_n_per_s * params.tick_s + 1e-12);
  const ToolState& held = rest_at(Vec3(0, 0, 0.5));
  EXPECT_NEAR(held.force_W.norm(), params.max_force_n, 1e-12);
  EXPECT_NE(held.status & kTickForceClamped, 0u);
  params.force_on = false;
  EXPECT_EQ(at(Vec3(0, 0, 0.5)).force_W.norm(), 0);
}

// A tick long delay in a sampled spring must not feed energy: a loose hand that is let go 20 mm
// away comes to rest where it grabbed.
TEST_F(Grab, ALooseHandComesToRest) {
  const Vec3 from(0, 0, 0.03);
  rest_at(from);
  params.grab_n_per_m = 1000;
  at(from);
  constexpr double kMass = 0.1, kTick = 0.001;
  Vec3 p = from + Vec3(0, 0, 0.006), v = Vec3::Zero();
  for (int i = 0; i < 4000; ++i) {
    v += kTick / kMass * at(p, v).force_W;
    p += kTick * v;
  }
  EXPECT_LT((p - from).norm(), 1e-4);
  EXPECT_LT(v.norm(), 1e-3);
}

TEST_F(Grab, IsPartOfTheState) {
  rest_at(Vec3(0, 0, 0.02));
  const std::uint64_t free = loop.state_hash();
  params.grab_n_per_m = kStiffness;
  at(Vec3(0, 0, 0.02));
  at(Vec3(0, 0, 0.024));
  const auto saved = loop.save();
  const std::uint64_t hash = loop.state_hash();
  EXPECT_NE(hash, free);
  const Vec3 force = at(Vec3(0, 0, 0.025)).force_W;
  loop.restore(*saved);
  EXPECT_EQ(loop.state_hash(), hash);
  EXPECT_EQ(at(Vec3(0, 0, 0.025)).force_W, force);
}

}  // namespace
}  // namespace osteon
