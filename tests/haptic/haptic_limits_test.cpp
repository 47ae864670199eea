// What the tick refuses and what it limits.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "osteon/base/random.h"
#include "osteon/haptic/haptic.h"
#include "test_scene.h"

namespace osteon {
namespace {

using test::floor_bone;
using test::go;
using test::proxy_gap;
using test::Rig;
using test::room;
using test::tip_reach;

TEST(HapticLoop, NotFiniteInputGivesZeroForceAndHoldsTheProxy) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (int field = 0; field < 13; ++field) {
    for (const double bad : {nan, inf, -inf}) {
      Rig rig({floor_bone()});
      rig.at(Vec3(0, 0, 0.003));
      const ToolState before = go(rig, Vec3(0, 0, 0.003), Vec3(0, 0, -0.001), 30);
      ASSERT_GT(before.force_W.z(), 1);
      ToolInput input;
      input.X_WD.p = Vec3(0, 0, -0.001);
      if (field < 3) input.X_WD.p[field] = bad;
      if (field >= 3 && field < 7) input.X_WD.q.coeffs()[field - 3] = bad;
      if (field >= 7 && field < 10) input.v_W[field - 7] = bad;
      if (field >= 10) input.w_W[field - 10] = bad;
      const ToolState& s = rig.loop.tick(input, rig.bones, 0, rig.params);
      EXPECT_EQ(s.force_W, Vec3(Vec3::Zero()));
      EXPECT_TRUE(s.status & kTickInputNotFinite);
      EXPECT_EQ(s.X_WP.p, before.X_WP.p);
      EXPECT_EQ(s.contact_count, 0u);
      // The next good sample goes on as if nothing had happened.
      const ToolState& after = rig.at(Vec3(0, 0, -0.001));
      EXPECT_EQ(after.status & kTickInputNotFinite, 0u);
      EXPECT_NEAR(after.force_W.z(), before.force_W.z(), 1e-6);
    }
  }
}

TEST(HapticLoop, BrokenQuaternionsFarPointsAndBrokenBonesAreRefused) {
  Rig rig({floor_bone()});
  rig.at(Vec3(0, 0, 0.003));
  ToolInput input;
  input.X_WD.q = Quat(0, 0, 0, 0);
  EXPECT_TRUE(rig.loop.tick(input, rig.bones, 0, rig.params).status & kTickInputNotFinite);
  input.X_WD.q = Quat::Identity();
  input.X_WD.p = Vec3(1e200, 0, 0);
  EXPECT_TRUE(rig.loop.tick(input, rig.bones, 0, rig.params).status & kTickInputNotFinite);
  rig.bones.bones[0].v_W.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(rig.at(Vec3(0, 0, 0.003)).status & kTickInputNotFinite);
  rig.bones.bones[0].v_W.x() = 0;
  EXPECT_EQ(rig.at(Vec3(0, 0, 0.003)).status, kTickOk);
}

TEST(HapticLoop, AForceThatIsNotFiniteIsZero) {
  Rig rig({floor_bone()});
  rig.at(Vec3(0, 0, 0.003));
  go(rig, Vec3(0, 0, 0.003), Vec3(0, 0, -0.001), 30);
  rig.params.damping_n_s_per_m = std::numeric_limits<double>::infinity();
  const ToolState& s = rig.at(Vec3(0, 0, -0.001), Quat::Identity(), Vec3(0, 0, -0.01));
  EXPECT_EQ(s.force_W, Vec3(Vec3::Zero()));
  EXPECT_TRUE(s.status & kTickForceNotFinite);
}

TEST(HapticLoop, ATeleportOverTenMetresAndBackEndsAtTheHand) {
  Rig rig({floor_bone()});
  rig.at(Vec3(0, 0, 0.003));
  // Free way: arrives at once.
  EXPECT_EQ(rig.at(Vec3(0, 0, 10)).X_WP.p, Vec3(0, 0, 10));
  // Through the bone: stops on the surface, on the side where it was.
  ToolState s = rig.at(Vec3(0, 0, -10));
  for (int i = 0; i < 20; ++i) {
    s = rig.at(Vec3(0, 0, -10));
    ASSERT_GT(proxy_gap(rig, s), 0);
    ASSERT_GT(s.X_WP.p.z(), 0);
    ASSERT_TRUE(is_finite(s.force_W));
  }
  // And home again.
  for (int i = 0; i < 20; ++i) s = rig.at(Vec3(0, 0, 0.003));
  EXPECT_EQ(s.X_WP.p, Vec3(0, 0, 0.003));
  EXPECT_EQ(s.force_W, Vec3(Vec3::Zero()));
}

TEST(HapticLoop, AStartInsideBonePutsTheProxyOutAndIsSilentUntilFree) {
  Rig rig({floor_bone()});
  for (int i = 0; i < 50; ++i) {
    const ToolState& s = rig.at(Vec3(0, 0, -0.001));
    ASSERT_EQ(s.force_W, Vec3(Vec3::Zero()));
    ASSERT_GT(proxy_gap(rig, s), 0);
    ASSERT_NEAR(s.X_WP.p.z(), tip_reach(rig), 1e-5);
    ASSERT_EQ(s.contact_count, 1u);
  }
  EXPECT_EQ(rig.at(Vec3(0, 0, 0.002)).force_W, Vec3(Vec3::Zero()));
  const ToolState& s = go(rig, Vec3(0, 0, 0.002), Vec3(0, 0, -0.001), 30);
  EXPECT_GT(s.force_W.z(), 1);
  rig.loop.reset();
  EXPECT_EQ(rig.at(Vec3(0, 0, -0.001)).force_W, Vec3(Vec3::Zero()));
}

TEST(HapticLoop, ForceIsClampedInItsDirectionAndSlewed) {
  Rig rig(room(1));
  rig.params = HapticParams{};
  rig.params.max_force_n = 2;
  rig.params.max_slew_n_per_s = 1000;
  rig.at(Vec3(0, 0, 0.003));
  Vec3 last = Vec3::Zero();
  std::uint32_t seen = 0;
  ToolState s;
  for (int i = 0; i < 60; ++i) {
    s = rig.at(Vec3(0.004, 0, -0.003));
    ASSERT_LE(s.force_W.norm(), 2 + 1e-12);
    ASSERT_LE((s.force_W - last).norm(), 1 + 1e-12);
    last = s.force_W;
    seen |= s.status;
  }
  EXPECT_TRUE(seen & kTickForceClamped);
  EXPECT_TRUE(seen & kTickForceSlewed);
  EXPECT_NEAR(s.force_W.norm(), 2, 1e-9);
  const Vec3 stretch = s.X_WP.p - s.X_WD.p;
  EXPECT_LT((s.force_W.normalized() - stretch.normalized()).norm(), 1e-9);
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < s.contact_count; ++i) sum += s.contacts[i].force_on_tool_W;
  EXPECT_LT((sum - s.force_W).norm(), 1e-12);
}

TEST(HapticLoop, ForceOffIsZeroButContactsAreSeen) {
  Rig rig({floor_bone()});
  rig.params.force_on = false;
  rig.at(Vec3(0, 0, 0.003));
  const ToolState& s = go(rig, Vec3(0, 0, 0.003), Vec3(0, 0, -0.001), 30);
  EXPECT_EQ(s.force_W, Vec3(Vec3::Zero()));
  ASSERT_EQ(s.contact_count, 1u);
  EXPECT_EQ(s.contacts[0].force_on_tool_W, Vec3(Vec3::Zero()));
}

TEST(HapticLoop, TheDamperNeverPullsTowardsBone) {
  Rig rig({floor_bone()});
  rig.params.damping_n_s_per_m = 30;
  const double z = tip_reach(rig);
  rig.at(Vec3(0, 0, 0.003));
  go(rig, Vec3(0, 0, 0.003), Vec3(0, 0, z - 1e-4), 30);
  const Vec3 out(0, 0, 0.1);
  EXPECT_EQ(rig.at(Vec3(0, 0, z - 1e-4), Quat::Identity(), out).force_W, Vec3(Vec3::Zero()));
  EXPECT_NEAR(rig.at(Vec3(0, 0, z - 1e-4), Quat::Identity(), -out).force_W.z(),
              2000 * (1e-4 + 1e-6) + 30 * 0.1, 1e-6);
}

}  // namespace
}  // namespace osteon
