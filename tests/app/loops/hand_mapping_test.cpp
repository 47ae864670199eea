#include "loops/hand_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "loops/assist.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

DeviceSample at(const Vec3& p_V, std::uint32_t buttons = 0) {
  DeviceSample sample;
  sample.X_VD.p = p_V;
  sample.v_V = Vec3(0.1, 0.2, 0.3);
  sample.buttons = buttons;
  return sample;
}

MappingSettings with_clutch(int button) {
  MappingSettings settings;
  settings.clutch_button = button;
  return settings;
}

TEST(MappingSettings, NonsenseBecomesTheDefaultAndExtremesTheBound) {
  MappingSettings odd;
  odd.scale = std::numeric_limits<double>::quiet_NaN();
  odd.friction_n = 50;
  odd.inertia_kg = -1;
  odd.clutch_button = 99;
  const MappingSettings s = sane(odd);
  EXPECT_EQ(s.scale, 1);
  EXPECT_EQ(s.friction_n, kMaxFriction_n);
  EXPECT_EQ(s.inertia_kg, 0);
  EXPECT_EQ(s.clutch_button, -1);
  EXPECT_EQ(sane({}), MappingSettings{});
}

TEST(MappingSettings, CompensationIsOffByDefault) {
  Assist assist{MappingSettings{}};
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(assist.force(Vec3(0.01 * i, 0, 0), 0.001), Vec3(Vec3::Zero()));
}

TEST(HandMapping, PatientAxesStandUpright) {
  const Quat q = patient_axes();
  EXPECT_LT((q * Vec3::UnitX() - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((q * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((q * Vec3::UnitZ() + Vec3::UnitY()).norm(), 1e-15);
}

TEST(HandMapping, ScaleStretchesPlaceAndVelocityButNotForce) {
  DeviceMapping start;
  start.X_WV = {Vec3(1, 2, 3), patient_axes()};
  start.scale = 2;
  HandMapping mapping(start, {});
  const ToolInput input = mapping.to_world(at(Vec3(0.01, 0, 0)), false);
  EXPECT_LT((input.X_WD.p - Vec3(1.02, 2, 3)).norm(), 1e-15);
  EXPECT_LT((input.v_W - Vec3(0.2, -0.6, 0.4)).norm(), 1e-15);
  EXPECT_LT((mapping.force_to_device(Vec3(0, 0, 5)) - Vec3(0, 5, 0)).norm(), 1e-14);
}

TEST(HandMapping, TheClutchHoldsTheToolAndLetsItGoWhereItIs) {
  HandMapping mapping({}, with_clutch(1));
  const Vec3 held = mapping.to_world(at(Vec3(0.05, 0, 0)), false).X_WD.p;
  for (int i = 0; i <= 100; ++i) {
    const ToolInput input = mapping.to_world(at(Vec3(0.05 - 0.001 * i, 0.002 * i, 0), 2), false);
    ASSERT_EQ(input.X_WD.p, held);
    ASSERT_EQ(input.v_W, Vec3(Vec3::Zero()));
    ASSERT_EQ(mapping.force_to_device(Vec3(3, 0, 0)), Vec3(Vec3::Zero()));
    ASSERT_FALSE(mapping.released());
  }
  const ToolInput after = mapping.to_world(at(Vec3(-0.05, 0.2, 0)), false);
  EXPECT_TRUE(mapping.released());
  EXPECT_LT((after.X_WD.p - held).norm(), 1e-15);
  EXPECT_EQ(mapping.force_to_device(Vec3(3, 0, 0)), Vec3(3, 0, 0));
  EXPECT_LT(
      (mapping.to_world(at(Vec3(-0.04, 0.2, 0)), false).X_WD.p - held - Vec3(0.01, 0, 0)).norm(),
      1e-15);
  EXPECT_FALSE(mapping.released());
}

TEST(HandMapping, APedalIsAClutchTooAndOtherButtonsAreNot) {
  HandMapping mapping({}, with_clutch(1));
  mapping.to_world(at(Vec3::Zero(), 5), false);
  EXPECT_FALSE(mapping.clutched());
  mapping.to_world(at(Vec3::Zero()), true);
  EXPECT_TRUE(mapping.clutched());
}

TEST(HandMapping, TurningTheAxesLeavesTheToolInPlace) {
  Random random(3);
  DeviceMapping start;
  start.scale = 1.5;
  HandMapping mapping(start, {});
  for (int i = 0; i < 100; ++i) {
    const Vec3 p_V = 0.1 * random.direction();
    const Vec3 before = mapping.to_world(at(p_V), false).X_WD.p;
    mapping.align(random.rotation());
    EXPECT_LT((mapping.to_world(at(p_V), false).X_WD.p - before).norm(), 1e-14);
  }
}

TEST(Assist, FollowsMotionAndAccelerationWithinItsBounds) {
  MappingSettings settings;
  settings.friction_n = 0.5;
  Assist friction(settings);
  Vec3 f = Vec3::Zero();
  for (int i = 0; i < 200; ++i) f = friction.force(Vec3(0, -0.1, 0), 0.001);
  EXPECT_LT((f - Vec3(0, -0.5, 0)).norm(), 1e-6);
  for (int i = 0; i < 200; ++i) f = friction.force(Vec3::Zero(), 0.001);
  EXPECT_LT(f.norm(), 1e-3);  // at rest: nothing that could start a motion

  settings = {};
  settings.inertia_kg = 0.1;
  Assist inertia(settings);
  for (int i = 0; i < 300; ++i) f = inertia.force(Vec3(0.004 * i, 0, 0), 0.001);  // 4 m/s^2
  EXPECT_NEAR(f.x(), 0.4, 0.01);
  for (int i = 0; i < 50; ++i) f = inertia.force(Vec3(i % 2 ? 10 : -10, 0, 0), 0.001);
  EXPECT_LE(f.norm(), Assist::kMost_n + 1e-12);
  EXPECT_EQ(inertia.force(Vec3(std::nan(""), 0, 0), 0.001), Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace osteon
