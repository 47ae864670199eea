#include "osteon/haptic/haptic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"
#include "test_scene.h"

namespace osteon {
namespace {

using test::bone_of;
using test::box_hull;
using test::floor_bone;
using test::go;
using test::proxy_gap;
using test::Rig;
using test::room;
using test::tip_reach;

TEST(HapticLoop, InFreeAirTheProxyIsTheHandAndNothingIsFelt) {
  Rig rig({floor_bone()});
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Vec3 dir = random.direction();
    const Vec3 p = Vec3(0, 0, 0.02) + 0.01 * dir;
    const ToolState& s = rig.at(p);
    ASSERT_EQ(s.X_WP.p, p);
    ASSERT_EQ(s.force_W, Vec3(Vec3::Zero()));
    ASSERT_EQ(s.contact_count, 0u);
    ASSERT_EQ(s.status, kTickOk);
    ASSERT_EQ(s.tick, static_cast<std::uint64_t>(i + 1));
  }
}

TEST(HapticLoop, WithoutBonesItRuns) {
  Rig rig({});
  EXPECT_EQ(rig.at(Vec3(1, 2, 3)).X_WP.p, Vec3(1, 2, 3));
}

TEST(HapticLoop, PressOnAFlatFaceIsASpringAlongItsNormal) {
  Rig rig({floor_bone()});
  const double reach = tip_reach(rig);
  rig.at(Vec3(0.001, 0.002, 0.005));
  const ToolState& s = go(rig, Vec3(0.001, 0.002, 0.005), Vec3(0.001, 0.002, -0.001), 60);
  EXPECT_NEAR(s.X_WP.p.z(), reach, 3e-6);
  EXPECT_GT(s.X_WP.p.z(), reach);
  EXPECT_NEAR(s.X_WP.p.x(), 0.001, 1e-9);
  EXPECT_NEAR(s.X_WP.p.y(), 0.002, 1e-9);
  ASSERT_EQ(s.contact_count, 1u);
  const Contact& c = s.contacts[0];
  EXPECT_EQ(c.bone.index, 0u);
  EXPECT_LT((c.nhat_BT_W - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(c.depth_m, 0.001 + reach, 3e-6);
  EXPECT_NEAR(c.p_W.z(), 0, 1e-5);
  EXPECT_LT((s.force_W - Vec3(0, 0, 2000 * c.depth_m)).norm(), 1e-9);
  EXPECT_LT((c.force_on_tool_W - s.force_W).norm(), 1e-12);
}

TEST(HapticLoop, MaterialBoundsTheStiffness) {
  Rig rig({floor_bone({500, 0, 0})});
  rig.at(Vec3(0, 0, 0.002));
  const ToolState& s = go(rig, Vec3(0, 0, 0.002), Vec3(0, 0, -0.001), 30);
  ASSERT_EQ(s.contact_count, 1u);
  EXPECT_NEAR(s.force_W.z(), 500 * s.contacts[0].depth_m, 1e-9);
}

TEST(HapticLoop, InACornerEachWallBearsItsOwnDepth) {
  for (const int walls : {1, 2}) {
    Rig rig(room(walls));
    const Vec3 start(0, 0, 0.003);
    const Vec3 hand(0.0025, walls > 1 ? 0.0022 : 0.0, -0.0003);
    rig.at(start);
    const ToolState& s = go(rig, start, hand, 100);
    ASSERT_EQ(s.contact_count, static_cast<std::uint32_t>(walls + 1));
    EXPECT_GT(proxy_gap(rig, s), 0);
    Vec3 sum = Vec3::Zero();
    for (std::uint32_t i = 0; i < s.contact_count; ++i) {
      const Contact& c = s.contacts[i];
      EXPECT_LT((c.force_on_tool_W - 2000 * c.depth_m * c.nhat_BT_W).norm(), 1e-6);
      sum += c.force_on_tool_W;
    }
    EXPECT_LT((sum - s.force_W).norm(), 1e-9);
    EXPECT_NEAR(s.force_W.z(), 2000 * (tip_reach(rig) - hand.z()), 0.01);
    EXPECT_NEAR(s.force_W.x(), -2000 * (hand.x() - 0.002 + tip_reach(rig, Vec3::UnitX())), 0.01);
    if (walls > 1) {
      EXPECT_NEAR(s.force_W.y(), -2000 * (hand.y() - 0.002 + tip_reach(rig, Vec3::UnitY())), 0.01);
    }
  }
}

TEST(HapticLoop, InAGrooveOfTwoPiecesTheProxyRestsOnBothFlanks) {
  // Two slabs, each tilted by 45 degrees, meeting in the line x = z = 0.
  const Quat left(Eigen::AngleAxisd(M_PI / 4, Vec3::UnitY()));
  const Quat right(Eigen::AngleAxisd(-M_PI / 4, Vec3::UnitY()));
  std::vector<Hull> pieces;
  for (const Quat& q : {left, right}) {
    std::vector<Vec3> corners;
    for (const Vec3& v : box_hull(Vec3(0.01, 0.02, 0.002), Vec3(0, 0, -0.002)).vertices)
      corners.push_back(q * v);
    pieces.push_back(test::hull_of(corners));
  }
  Rig rig({bone_of(std::move(pieces))});
  rig.at(Vec3(0.0002, 0, 0.005));
  const ToolState& s = go(rig, Vec3(0.0002, 0, 0.005), Vec3(0.0002, 0, 0.0005), 100);
  ASSERT_EQ(s.contact_count, 2u);
  EXPECT_GT(proxy_gap(rig, s), 0);
  EXPECT_LT(proxy_gap(rig, s), 2e-6);
  EXPECT_NEAR(s.X_WP.p.x(), 0, 2e-5);  // the tip is symmetric to within its facets
  EXPECT_GT(s.force_W.z(), 0.5);
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(s.contacts[i].force_on_tool_W.dot(s.contacts[i].nhat_BT_W), 0);
    EXPECT_NEAR(s.contacts[i].nhat_BT_W.z(), std::sqrt(0.5), 1e-6);
  }
  // Along the groove nothing resists.
  const double before = s.force_W.z();
  const ToolState& slid = go(rig, Vec3(0.0002, 0, 0.0005), Vec3(0.0002, 0.01, 0.0005), 500);
  EXPECT_NEAR(slid.X_WP.p.y(), 0.01, 1e-6);
  EXPECT_NEAR(slid.force_W.y(), 0, 1e-3);
  EXPECT_NEAR(slid.force_W.z(), before, 1e-3);
}

TEST(HapticLoop, SlidingOverAnEdgeIsSmooth) {
  Rig rig({floor_bone()});
  const double reach = tip_reach(rig);
  const double depth = 0.0003;
  const Vec3 start(0.018, 0.001, reach - depth);
  rig.at(start + Vec3(0, 0, 0.002));
  go(rig, start + Vec3(0, 0, 0.002), start, 100);
  Vec3 last = rig.at(start).force_W;
  EXPECT_NEAR(last.z(), 2000 * depth, 0.01);
  double largest_change = 0;
  for (int i = 0; i < 400; ++i) {  // 20 mm/s for 8 mm, over the edge at x = 20 mm
    const ToolState& s = rig.at(start + Vec3(2e-5 * i, 0, 0));
    ASSERT_GT(proxy_gap(rig, s), 0) << i;
    ASSERT_LE(s.force_W.norm(), 2000 * depth * 1.02) << i;
    largest_change = std::max(largest_change, (s.force_W - last).norm());
    last = s.force_W;
  }
  EXPECT_EQ(last, Vec3(Vec3::Zero()));  // it left the bone
  // The step of the hand alone gives 2e-5 m x 2000 N/m = 0.04 N. The tip's facets meet at up to
  // 41 degrees: without a glide the force would jump by 2000 x 0.0003 x sin(41 deg) = 0.39 N.
  EXPECT_LT(largest_change, 0.1);
}

TEST(HapticLoop, FrictionSticksUpToTheStaticRatioAndSlidesAtTheDynamicOne) {
  for (const double scale : {1.0, 0.5}) {
    Rig rig({floor_bone({1e4, 0.5, 0.3})});
    rig.params.friction_scale = scale;
    const double reach = tip_reach(rig);
    const double z = reach - 0.001;
    rig.at(Vec3(0, 0, 0.003));
    go(rig, Vec3(0, 0, 0.003), Vec3(0, 0, z), 100);
    const double step = 1e-6;
    double onset = -1;
    double peak = 0;
    ToolState s;
    for (int i = 0; i < 2000; ++i) {
      s = rig.at(Vec3(step * i, 0, z));
      ASSERT_GT(proxy_gap(rig, s), 0);
      if (onset < 0) {
        peak = std::max(peak, -s.force_W.x());
        if (!(s.status & kTickSticking)) onset = step * i;
      }
    }
    const double load = 0.001 + 1e-6;  // with the skin
    EXPECT_NEAR(onset, 0.5 * scale * load, 2 * step);
    EXPECT_NEAR(peak, 0.5 * scale * 2000 * load, 2000 * 2 * step);
    EXPECT_FALSE(s.status & kTickSticking);
    EXPECT_NEAR(-s.force_W.x(), 0.3 * scale * s.force_W.z(), 1e-3);  // Coulomb
    EXPECT_NEAR(s.force_W.z(), 2000 * load, 1e-3);
    // Turning round sticks again, until the force has turned to the other side.
    const double turn = 2000 * step;
    int stuck = 0;
    for (int i = 0; i < 2000; ++i)
      stuck += (rig.at(Vec3(turn - step * i, 0, z)).status & kTickSticking) ? 1 : 0;
    EXPECT_NEAR(stuck * step, (0.5 + 0.3) * scale * load, 5 * step);
  }
}

TEST(HapticLoop, WithoutFrictionNothingSticks) {
  Rig rig({floor_bone({1e4, 0.5, 0.3})});
  rig.params.friction_scale = 0;
  const double z = tip_reach(rig) - 0.001;
  rig.at(Vec3(0, 0, 0.003));
  go(rig, Vec3(0, 0, 0.003), Vec3(0, 0, z), 100);
  for (int i = 0; i < 100; ++i) {
    const ToolState& s = rig.at(Vec3(1e-5 * i, 0, z));
    ASSERT_NEAR(s.X_WP.p.x(), 1e-5 * i, 1e-9);
    ASSERT_FALSE(s.status & kTickSticking);
    ASSERT_NEAR(s.force_W.x(), 0, 1e-6);
  }
}

TEST(HapticLoop, ThePlateIsNotTunnelledFromAnySide) {
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    Pose X_WB;
    if (trial >= 6) X_WB.q = random.rotation();
    Rig rig({bone_of({box_hull(Vec3(0.02, 0.02, 0.00025))}, X_WB)});
    const double side = trial % 2 ? 1 : -1;
    const double x = random.uniform(-0.003, 0.003);
    const double y = random.uniform(-0.003, 0.003);
    const double far = random.uniform(0.002, 0.01);
    const Quat turn = random.rotation();
    rig.at(X_WB * Vec3(0, 0, side * 0.003), turn);
    for (int i = 0; i < 30; ++i) {
      const ToolState& s = rig.at(X_WB * Vec3(x, y, -side * far), turn);
      const Vec3 p_B = X_WB.inverse() * s.X_WP.p;
      ASSERT_GT(side * p_B.z(), 0.00025) << trial;
      ASSERT_GT(proxy_gap(rig, s), 0) << trial;
      if (i > 2) {
        ASSERT_GT(side * (X_WB.q.conjugate() * s.force_W).z(), 1);
      }
    }
  }
}

TEST(HapticLoop, TurningALongToolDoesNotPassAPlate) {
  Tool blade = test::tool_of(box_hull(Vec3(0.02, 0.0005, 0.0005)));
  Rig rig({bone_of({box_hull(Vec3(0.0002, 0.03, 0.03), Vec3(0.01, 0, 0))})}, std::move(blade));
  // The blade stands along y at x = 5 mm and is asked to lie along x, through the plate at 10 mm.
  const Quat upright(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));
  rig.at(Vec3(0.005, 0, 0), upright);
  for (int i = 0; i < 200; ++i) {
    const ToolState& s = rig.at(Vec3(0.005, 0, 0), Quat::Identity());
    ASSERT_GT(proxy_gap(rig, s), 0);
    double highest = -1;
    for (const Vec3& v : rig.tool->pieces[0].vertices)
      highest = std::max(highest, (s.X_WP * v).x());
    ASSERT_LT(highest, 0.0098) << i;  // all of it stays on its side
  }
}

TEST(HapticLoop, ATurnBetweenTwoWallsIsHeld) {
  // A slot 2.2 mm wide, longer than the blade: there is no room to turn.
  Tool blade = test::tool_of(box_hull(Vec3(0.01, 0.001, 0.001)));
  Rig rig({bone_of({box_hull(Vec3(0.03, 0.01, 0.01), Vec3(0, 0.0111, 0))}),
           bone_of({box_hull(Vec3(0.03, 0.01, 0.01), Vec3(0, -0.0111, 0))})},
          std::move(blade));
  rig.at(Vec3::Zero());
  const Quat across(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));
  bool held = false;
  for (int i = 0; i < 50; ++i) {
    const ToolState& s = rig.at(Vec3::Zero(), across);
    held = held || (s.status & kTickRotationHeld);
    ASSERT_FALSE(s.status & kTickProxyBlocked);
    ASSERT_GT(proxy_gap(rig, s), 0);
    ASSERT_LT(s.X_WP.q.angularDistance(Quat::Identity()), 0.05);
  }
  EXPECT_TRUE(held);
}

// Once it is above the slot nothing holds the turn any more.
TEST(HapticLoop, ATurnThatASlotHeldIsFreeAboveIt) {
  Tool blade = test::tool_of(box_hull(Vec3(0.01, 0.001, 0.001)));
  Rig rig({bone_of({box_hull(Vec3(0.03, 0.01, 0.01), Vec3(0, 0.0111, 0))}),
           bone_of({box_hull(Vec3(0.03, 0.01, 0.01), Vec3(0, -0.0111, 0))})},
          std::move(blade));
  rig.at(Vec3::Zero());
  const Quat across(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));
  for (int i = 0; i < 50; ++i) rig.at(Vec3::Zero(), across);
  for (int i = 0; i <= 400; ++i) {
    const ToolState& s = rig.at(Vec3(0, 0, 3.5e-5 * i), across);
    ASSERT_GT(proxy_gap(rig, s), 0) << i;
  }
  const ToolState* s = nullptr;
  for (int i = 0; i < 100; ++i) s = &rig.at(Vec3(0, 0, 0.014), across);
  EXPECT_LT(s->X_WP.q.angularDistance(across), 0.01);
  EXPECT_FALSE(s->status & kTickRotationHeld);
}

}  // namespace
}  // namespace osteon
