// How far a tip is from what it is nearest to: bone, or a soft part that is felt.
#include "window/controllers/sessions/tip_gauge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "session/skin_fixtures.h"
#include "session/soft_fixtures.h"
#include "session/soft_solid_fixtures.h"

namespace osteon {
namespace {

using testing::kMeniscusHalf;

// A block of meniscus, its middle the origin, 40 mm over the middle of a block of bone.
struct Gauge {
  Gauge() {
    view.softs[0].visible = true;
    tip.begin(the_case);
    tip.wait();
  }
  std::optional<TipGauge::Nearest> at(const Vec3& p_W) {
    RenderSnapshot snapshot;
    snapshot.bones = rest_snapshot(*the_case);
    snapshot.tool.X_WP.p = p_W;
    return tip.nearest(snapshot, view);
  }
  void feel(const std::shared_ptr<const SoftSetup>& felt) {
    tip.feel(felt);
    tip.wait();
  }

  std::shared_ptr<const Case> the_case = testing::meniscus_run().the_case;
  TipGauge tip;
  ViewState view = default_view(*the_case);
};

TEST(TipGauge, APlaceThatIsNoNumberHasNoDistance) {
  Gauge gauge;
  EXPECT_FALSE(gauge.at({std::numeric_limits<double>::quiet_NaN(), 0, 0}));
}

TEST(TipGauge, WhatIsNotFeltIsPassedOver) {
  Gauge gauge;
  const auto bone = gauge.at({0, 0, 0.008});
  ASSERT_TRUE(bone);
  EXPECT_FALSE(bone->soft);
  EXPECT_GT(bone->distance_m, 0.02);
}

// How deep a drill is in its hole, along the hole.
TEST(TipGauge, ADrillsDepthIsTakenAlongItsHole) {
  Gauge gauge;
  const double top = 0.008 - gauge.at({0, 0, 0.008})->distance_m;
  RenderSnapshot snapshot;
  snapshot.bones = rest_snapshot(*gauge.the_case);
  ToolGuide& guide = snapshot.bones.guides[1];
  const auto depth_mm = [&](double under_top, std::size_t hand) {
    snapshot.tool.X_WP = {Vec3(0, 0, top) - under_top * guide.nhat_B, Quat::Identity()};
    const auto deep = gauge.tip.depth_m(snapshot, hand);
    return deep ? 1e3 * *deep : -1.0;
  };
  EXPECT_EQ(depth_mm(0.005, 1), -1) << "in no hole";
  guide.on = guide.in_hole = true;
  EXPECT_NEAR(depth_mm(0.005, 1), 5, 0.1);
  EXPECT_EQ(depth_mm(0.005, 0), -1) << "another hand's";
  EXPECT_EQ(depth_mm(0.005, 99), -1);
  guide.nhat_B = Vec3(0.5, 0, std::sqrt(0.75));
  EXPECT_NEAR(depth_mm(0.004, 1), 4, 0.1) << "slanted";
  EXPECT_EQ(depth_mm(-0.001, 1), 0) << "before its mouth";
  snapshot.tool.instrument = 3;
  EXPECT_EQ(depth_mm(0.005, 1), -1) << "another instrument";
}

TEST(TipGauge, AFeltMeniscusCountsUntilItIsFeltNoMore) {
  Gauge gauge;
  gauge.feel(testing::meniscus_run().softs);
  const auto soft = gauge.at({0, 0, 0.008});
  ASSERT_TRUE(soft && soft->soft);
  EXPECT_EQ(gauge.the_case->softs[*soft->soft].name, "medial_meniscus");
  EXPECT_NEAR(soft->distance_m, 0.008 - kMeniscusHalf.z(), 1e-9);
  EXPECT_NEAR((soft->p_W - Vec3(0, 0, kMeniscusHalf.z())).norm(), 0, 1e-9);
  const auto inside = gauge.at({0, 0, 0.001});
  ASSERT_TRUE(inside && inside->soft);
  EXPECT_NEAR(inside->distance_m, 0.001 - kMeniscusHalf.z(), 1e-9);
  gauge.feel(nullptr);
  EXPECT_FALSE(gauge.at({0, 0, 0.008})->soft);
}

// A ligament between two boxes, 3 mm thick all round, as far as its bones stand apart.
TEST(TipGauge, AFeltLigamentCountsAsTheCordThatItIs) {
  const testing::BandRun run;
  TipGauge tip;
  tip.begin(run.the_case);
  tip.feel(run.softs);
  tip.wait();
  ViewState view = default_view(*run.the_case);
  view.softs[0].visible = true;
  RenderSnapshot snapshot;
  snapshot.bones = rest_snapshot(*run.the_case);
  snapshot.tool.X_WP.p = testing::kBandMiddle + Vec3(0.002, 0, 0.007);
  const auto found = tip.nearest(snapshot, view);
  ASSERT_TRUE(found && found->soft);
  EXPECT_EQ(run.the_case->softs[*found->soft].name, "acl");
  EXPECT_NEAR(found->distance_m, 0.007 - run.softs->bands[0].radius_m, 1e-9);
  EXPECT_NEAR((found->p_W - snapshot.tool.X_WP.p).norm(), found->distance_m, 1e-9);
  view.softs[0].visible = false;
  const auto bone = tip.nearest(snapshot, view);
  EXPECT_FALSE(bone && bone->soft);
}

TEST(TipGauge, WhatIsHiddenIsPassedOver) {
  Gauge gauge;
  gauge.feel(testing::meniscus_run().softs);
  gauge.view.softs[0].visible = false;
  EXPECT_FALSE(gauge.at({0, 0, 0.008})->soft);
}

// The bone of the skin's case lies 54 mm under it.
TEST(TipGauge, FeltSkinCountsForWhoIsOutsideOfIt) {
  const testing::SkinRun& run = testing::skin_run();
  TipGauge tip;
  tip.begin(run.the_case);
  tip.feel(run.softs);
  tip.wait();
  ViewState view = default_view(*run.the_case);
  view.softs[0].visible = true;
  const auto at = [&](const Vec3& p_W) {
    RenderSnapshot snapshot;
    snapshot.bones = rest_snapshot(*run.the_case);
    snapshot.tool.X_WP.p = p_W;
    return tip.nearest(snapshot, view);
  };
  const auto over = at({0.003, 0.004, 0.007});
  ASSERT_TRUE(over && over->soft);
  EXPECT_EQ(run.the_case->softs[*over->soft].name, "skin");
  EXPECT_NEAR(over->distance_m, 0.007, 1e-4);
  const auto cutting = at({0, 0, -0.001});
  ASSERT_TRUE(cutting && cutting->soft);
  EXPECT_NEAR(cutting->distance_m, -0.001, 1e-4);
  const auto inside = at({0, 0, -0.020});
  ASSERT_TRUE(inside);
  EXPECT_FALSE(inside->soft);
  EXPECT_NEAR(inside->distance_m, 0.040 - testing::kBoxHalf.z(), 1e-9);
  // Beside the patch and under it the skin is none, whatever its border is nearest to.
  const auto beside = at({0.030, 0.030, -0.010});
  ASSERT_TRUE(beside);
  EXPECT_FALSE(beside->soft);
}

}  // namespace
}  // namespace osteon
