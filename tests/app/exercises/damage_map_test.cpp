#include "exercises/damage_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/loops/fake_device.h"

namespace osteon {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// The tool's own point at its origin touches the top of the block "near" at z = 0 with 2 N.
ToolState touching(double x_m, double force_n = 2) {
  ToolState tool;
  tool.X_WP.p = Vec3(x_m, 0, 0);
  tool.contact_count = 1;
  tool.contacts[0].bone = BoneId{0};
  tool.contacts[0].p_W = tool.X_WP.p;
  tool.contacts[0].force_on_tool_W = Vec3(0, 0, force_n);
  return tool;
}

struct Touched {
  std::shared_ptr<const Case> the_case = test::blocks_case();
  BoneSnapshot bones = rest_snapshot(*the_case);
  DamageMaker maker{*the_case, 2};
  double total(DamageKind kind) const {
    double sum = 0;
    for (const auto& spots : maker.finish())
      for (const DamageSpot& spot : spots) sum += spot.of(kind);
    return sum;
  }
};

TEST(DamageMap, NothingTouchedLeavesNothing) {
  Touched t;
  t.maker.touch(0, ToolState{}, t.bones);
  t.maker.touch(7, touching(0), t.bones);  // no such hand
  ToolState lost = touching(0);
  lost.X_WP.p.x() = kNan;
  t.maker.touch(0, lost, t.bones);
  ToolState odd = touching(0);
  odd.contacts[0].force_on_tool_W.x() = kNan;
  t.maker.touch(0, odd, t.bones);
  const DamageMap map = t.maker.finish();
  ASSERT_EQ(map.size(), 2u);
  EXPECT_TRUE(map[0].empty() && map[1].empty());
  for (const DamageKind kind : kDamageKinds) EXPECT_FALSE(shows_damage(map, kind));
}

TEST(DamageMap, KeepsTheGreatestForceOfAPlaceInTheBonesFrame) {
  Touched t;
  for (const double n : {1.0, 3.5, 2.0}) t.maker.touch(0, touching(0.001, n), t.bones);
  const DamageMap map = t.maker.finish();
  ASSERT_EQ(map[0].size(), 1u);
  EXPECT_EQ(map[0][0].force_n, 3.5);
  EXPECT_NEAR((map[0][0].p_B - Vec3(0.001, 0, 0.010)).norm(), 0, 1e-12);
  EXPECT_EQ(map[0][0].scratch_nmm, 0) << "it rested";
  EXPECT_TRUE(shows_damage(map, DamageKind::kForce));
  EXPECT_FALSE(shows_damage(map, DamageKind::kScratch));
}

TEST(DamageMap, AScratchIsForceTimesWay) {
  Touched t;
  // 10 mm under 2 N in 100 ticks; the first tick only begins.
  for (int i = 0; i <= 100; ++i) t.maker.touch(0, touching(1e-4 * i), t.bones);
  EXPECT_NEAR(t.total(DamageKind::kScratch), 20, 1e-9);
  EXPECT_GE(t.maker.finish()[0].size(), 20u) << "spots of 0.5 mm along 10 mm";
}

TEST(DamageMap, PushingDeeperIsNoScratch) {
  Touched t;
  for (int i = 0; i <= 100; ++i) {
    ToolState tool = touching(0);
    tool.X_WP.p.z() = tool.contacts[0].p_W.z() = -1e-5 * i;
    t.maker.touch(0, tool, t.bones);
  }
  EXPECT_NEAR(t.total(DamageKind::kScratch), 0, 1e-12);
}

// A ball of 5 mm that rolls along x: the contact goes 6 mm, no point of it slides.
TEST(DamageMap, RollingIsNoScratch) {
  Touched t;
  const double r = 0.005;
  for (int i = 0; i <= 600; ++i) {
    const double x = 1e-5 * i;
    ToolState tool = touching(x);
    tool.X_WP.p = Vec3(x, 0, r);
    tool.X_WP.q = Quat(Eigen::AngleAxisd(x / r, Vec3::UnitY()));
    t.maker.touch(0, tool, t.bones);
  }
  // Of a step the second order remains.
  EXPECT_LT(t.total(DamageKind::kScratch), 0.02);
}

TEST(DamageMap, ABoneThatGoesAlongIsNotScratched) {
  Touched t;
  for (int i = 0; i <= 100; ++i) {
    t.bones.bones[0].X_WB.p.x() = 1e-4 * i;
    t.maker.touch(0, touching(1e-4 * i), t.bones);
  }
  EXPECT_NEAR(t.total(DamageKind::kScratch), 0, 1e-9);
}

TEST(DamageMap, AnExchangeOrAStepBackIsNoScratch) {
  Touched t;
  t.maker.touch(0, touching(0), t.bones);
  ToolState other = touching(0.001);
  other.instrument = 1;
  t.maker.touch(0, other, t.bones);
  ToolState back = touching(0.002);
  back.instrument = 1;
  back.epoch = 1;
  t.maker.touch(0, back, t.bones);
  EXPECT_EQ(t.total(DamageKind::kScratch), 0);
  // The other hand's tool is another.
  t.maker.touch(1, touching(0.003), t.bones);
  EXPECT_EQ(t.total(DamageKind::kScratch), 0);
}

TEST(DamageMap, HeatIsKeptFromWhereItCanBeSeen) {
  Touched t;
  t.maker.warm(0, Vec3(0, 0, 0.01), 37.0);
  t.maker.warm(9, Vec3(0, 0, 0.01), 60.0);  // no such bone
  EXPECT_FALSE(shows_damage(t.maker.finish(), DamageKind::kHeat));
  t.maker.warm(0, Vec3(0, 0, 0.01), 52.0);
  t.maker.warm(0, Vec3(0, 0, 0.01), 44.0);
  const DamageMap map = t.maker.finish();
  ASSERT_EQ(map[0].size(), 1u);
  EXPECT_EQ(map[0][0].heat_c, 52.0);
  EXPECT_EQ(map[0][0].force_n, 0);
}

TEST(DamageMap, ScalesEndWhereTheLimitsAre) {
  EXPECT_EQ(share_of(DamageKind::kForce, 4), 1);
  EXPECT_EQ(share_of(DamageKind::kForce, 9), 1);
  EXPECT_EQ(share_of(DamageKind::kScratch, 2), 0.5);
  EXPECT_EQ(share_of(DamageKind::kHeat, 37), 0);
  EXPECT_EQ(share_of(DamageKind::kHeat, 42), 0.5);
  EXPECT_EQ(share_of(DamageKind::kHeat, 0), 0) << "not followed";
}

TEST(DamageMap, ColoursOfPointsFallOffBesideASpot) {
  DamageSpot spot;
  spot.p_B = Vec3(0.01, 0, 0);
  spot.force_n = 2;
  const std::vector<std::array<float, 3>> points = {
      {0.01f, 0, 0}, {0.01f, 0.0004f, 0}, {0.01f, 0, 0.00085f}, {0.0113f, 0, 0}, {-0.01f, 0, 0}};
  const auto shares = damage_at(std::span(&spot, 1), DamageKind::kForce, points);
  ASSERT_EQ(shares.size(), points.size());
  EXPECT_FLOAT_EQ(shares[0], 0.5f);
  EXPECT_FLOAT_EQ(shares[1], 0.5f);
  EXPECT_NEAR(shares[2], 0.25, 1e-3) << "half way out";
  EXPECT_EQ(shares[3], 0);
  EXPECT_EQ(shares[4], 0);
  for (const float share : damage_at(std::span(&spot, 1), DamageKind::kHeat, points))
    EXPECT_EQ(share, 0);
  EXPECT_TRUE(damage_at({}, DamageKind::kForce, {}).empty());
}

}  // namespace
}  // namespace osteon
