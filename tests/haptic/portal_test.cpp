// A shaft in a hole of the skin: it pivots, cannot leave sideways, rubs along, and may be
// withdrawn.
#include "osteon/scene/portal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "portal_pivot.h"
#include "test_scene.h"

namespace osteon {
namespace {

using test::Rig;

constexpr double kIntent_n = 20;
constexpr double kHandStiffness = 2000;

// Two holes in a skin that lies in the plane z = 0; inwards is down.
std::vector<Portal> two_portals() {
  Portal a;
  a.name = "portal_a";
  Portal b = a;
  b.name = "portal_b";
  b.p_W = Vec3(0.03, 0, 0);
  return {a, b};
}

Tool shaft_tool() {
  Tool tool;
  tool.name = "shaft";
  tool.shaft = {Vec3(0, 0, 0.001), Vec3(0, 0, 0.15), 0.001};
  tool.parts.push_back(make_rod(Vec3::Zero(), Vec3::Zero(), 0.001));
  tool.parts.push_back(make_rod(tool.shaft.p0, tool.shaft.p1, tool.shaft.radius));
  return tool;
}

struct PortalRig : Rig {
  std::vector<Portal> portals = two_portals();
  explicit PortalRig(std::vector<Bone> others = {far_bone()})
      : Rig(std::move(others), shaft_tool()) {
    params.damping_n_s_per_m = 2;
    params.max_slew_n_per_s = 1e9;
    loop.set_portals(portals);
  }
  static Bone far_bone() {
    return test::bone_of({test::box_hull(Vec3::Constant(0.001), Vec3(0, 0, -0.4))});
  }
  double off(std::size_t portal, const ToolState& s) const {
    return off_portal(portals[portal], tool->shaft, s.X_WP);
  }
  // From 20 mm above the skin to a depth of the tip.
  const ToolState& enter(double x, double depth, int ticks = 100) {
    at(Vec3(x, 0, 0.02));
    const ToolState* s = nullptr;
    for (int i = 1; i <= ticks; ++i) s = &at(Vec3(x, 0, 0.02 - (0.02 + depth) * i / ticks));
    for (int i = 0; i < 60; ++i) s = &at(Vec3(x, 0, -depth));
    return *s;
  }
};

TEST(Portal, WithoutOneNothingIsFelt) {
  Rig rig({PortalRig::far_bone()}, shaft_tool());
  rig.at(Vec3(0, 0, 0.02));
  const ToolState& s = test::go(rig, Vec3(0, 0, 0.02), Vec3(0.01, 0, -0.03), 100);
  EXPECT_EQ(s.portal, kNoPortal);
  EXPECT_EQ(s.force_W.norm(), 0);
}

TEST(Portal, IsEnteredThroughTheSkinAndLeftThroughIt) {
  PortalRig rig;
  rig.at(Vec3(0, 0, 0.02));
  std::uint32_t before = kNoPortal;
  for (int i = 0; i <= 200; ++i) {
    const double z = 0.02 - 2e-4 * i;
    const ToolState& s = rig.at(Vec3(0, 0, z));
    const double tip = z + 0.001;
    if (tip > 0) {
      EXPECT_EQ(s.portal, kNoPortal) << z;
    }
    if (tip < -0.0005) {
      EXPECT_EQ(s.portal, 0u) << z;
    }
    before = s.portal;
  }
  EXPECT_EQ(before, 0u);
  for (int i = 0; i <= 200; ++i) before = rig.at(Vec3(0, 0, -0.02 + 2e-4 * i)).portal;
  EXPECT_EQ(before, kNoPortal);
  // And into the other one.
  for (int i = 0; i <= 100; ++i) rig.at(Vec3(0.03 * i / 100, 0, 0.02));
  EXPECT_EQ(rig.enter(0.03, 0.02).portal, 1u);
}

// A hand of 0.15 kg with a grip of 500 N/m, which yields to the force that it feels.
struct YieldingHand {
  Vec3 p_W, v_W = Vec3::Zero();
  void step(const Vec3& wanted_W, const Vec3& force_W) {
    constexpr double kMass = 0.15, kGrip = 500, kDamping = 12, kTick = 0.001;
    const Vec3 pull = kGrip * (wanted_W - p_W) - kDamping * v_W + force_W;
    v_W += kTick / kMass * pull;
    p_W += kTick * v_W;
  }
};

// Wherever within reach of the hole and however tilted a hand wants the tip just below the skin: it
// is in or out, not both by turns, though the skin pushes the hand.
TEST(Portal, AShaftAtTheRimDoesNotComeAndGo) {
  Random random(3);
  int most = 0, entered = 0;
  for (int run = 0; run < 200; ++run) {
    PortalRig rig;
    rig.params.max_slew_n_per_s = 4000;
    const double tilt = random.uniform(-1.1, 1.1);
    const Quat q(std::cos(0.5 * tilt), 0, std::sin(0.5 * tilt), 0);
    const double x = random.uniform(-0.0049, 0.0049);
    const double y = random.uniform(-0.003, 0.003);
    const double depth = random.uniform(-0.0002, 0.0015);
    const Vec3 rim = Vec3(x, y, -depth) - q * rig.tool->shaft.p0;
    YieldingHand hand{rim + Vec3(0, 0, 0.01)};
    std::uint32_t before = kNoPortal;
    int changes = 0;
    Vec3 force = Vec3::Zero();
    for (int i = 0; i < 800; ++i) {
      const Vec3 wanted =
          rim + Vec3(0, 0, std::max(0.0, 0.01 - 5e-5 * i) + 1e-4 * std::sin(0.012 * i));
      hand.step(wanted, force);
      const ToolState& s = rig.at(hand.p_W, q, hand.v_W);
      force = s.force_W;
      changes += s.portal != before ? 1 : 0;
      before = s.portal;
    }
    entered += before != kNoPortal ? 1 : 0;
    most = std::max(most, changes);
  }
  EXPECT_LE(most, 3);
  EXPECT_GT(entered, 50);
}

TEST(Portal, SkinElsewhereIsNoPortal) {
  PortalRig rig;
  EXPECT_EQ(rig.enter(0.015, 0.02).portal, kNoPortal);
}

// The hand pulls sideways by 10 mm, which is 20 N on its spring, at any depth and in any direction,
// held turned or not.
TEST(Portal, PressedSidewaysTheShaftLeavesItByLessThanAMillimetre) {
  const double pull = kIntent_n / kHandStiffness;
  for (const double depth : {0.002, 0.01, 0.03, 0.08})
    for (int direction = 0; direction < 8; ++direction) {
      PortalRig rig;
      rig.enter(0, depth);
      const double a = direction * std::acos(-1.0) / 4;
      const Vec3 side(std::cos(a), std::sin(a), 0);
      double farthest = 0, most = 0;
      for (int i = 1; i <= 400; ++i) {
        const double share = std::min(1.0, i / 100.0);
        const ToolState& s = rig.at(Vec3(0, 0, -depth) + share * pull * side);
        ASSERT_EQ(s.portal, 0u);
        farthest = std::max(farthest, rig.off(0, s));
        most = std::max(most, -s.force_W.dot(side));
      }
      EXPECT_LT(farthest, 0.001) << depth << " " << direction;
      EXPECT_GT(most, 0.1) << depth;  // it is felt
      EXPECT_LT(most, kIntent_n);
    }
}

// However fast: the hand leaps, with bone under the tip that slips away.
TEST(Portal, NeitherALeapNorBoneBringsTheShaftOut) {
  for (const bool with_bone : {false, true}) {
    std::vector<Bone> bones{PortalRig::far_bone()};
    if (with_bone) {
      bones.push_back(test::bone_of({test::box_hull(Vec3(0.004, 0.02, 0.01), Vec3(0.01, 0, -0.03))},
                                    {}, {2000, 0.2, 0.1}));
      bones.push_back(
          test::field_bone(test::cube(0.006), {Vec3(-0.012, 0, -0.03), Quat::Identity()}));
    }
    PortalRig rig(std::move(bones));
    rig.enter(0, 0.03);
    Random random(21);
    Vec3 to(0, 0, -0.03);
    int touched = 0;
    for (int i = 0; i < 4000; ++i) {
      if (i % 40 == 0)
        to = Vec3(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02),
                  random.uniform(-0.04, -0.012));
      const ToolState& s = rig.at(to);
      if (s.portal != 0) break;
      EXPECT_LT(rig.off(0, s), 0.001) << with_bone << " " << i;
      touched += s.contact_count > 0;
    }
    EXPECT_EQ(rig.at(to).portal, 0u);
    if (with_bone) {
      EXPECT_GT(touched, 200);
    }
  }
}

TEST(Portal, AStraightPushMeetsFrictionAlone) {
  PortalRig rig;
  rig.enter(0, 0.01);
  const PortalSkin skin = rig.portals[0].skin;
  double most = 0;
  ToolState s;
  for (int i = 0; i < 300; ++i) {
    s = rig.at(Vec3(0, 0, -0.01 - 1e-4 * i));
    most = std::max(most, s.force_W.z());
    EXPECT_NEAR(s.force_W.head<2>().norm(), 0, 1e-9);
  }
  EXPECT_NEAR(most, skin.static_friction * skin.squeeze_n, 0.06);
  EXPECT_NEAR(s.force_W.z(), skin.dynamic_friction * skin.squeeze_n, 1e-6);
  EXPECT_NEAR((s.X_WP.p - s.X_WD.p).norm(), 0, 1e-9);
  // Back out: the other way, as much.
  for (int i = 0; i < 150; ++i) s = rig.at(Vec3(0, 0, -0.04 + 1e-4 * i));
  EXPECT_NEAR(s.force_W.z(), -skin.dynamic_friction * skin.squeeze_n, 1e-6);
}

TEST(Portal, ATipThatMovesSidewaysSwingsTheShaftAboutTheHole) {
  PortalRig rig;
  rig.enter(0, 0.04);
  ToolState s;
  for (int i = 1; i <= 300; ++i) s = rig.at(Vec3(0.01 * std::min(1.0, i / 200.0), 0, -0.04));
  // From the hole to the tip it points; the tip is nearly where the hand is.
  const Vec3 along = s.X_WP.rotate(Vec3::UnitZ());
  const Vec3 line = (Vec3::Zero() - s.X_WP.p).normalized();
  EXPECT_GT(along.dot(line), 0.999);
  EXPECT_LT((s.X_WP.p - s.X_WD.p).norm(), 0.003);
  EXPECT_GT(std::acos(along.z()), 0.15);
}

// A hand of 0.1 kg pulled into the skin sideways, and let go: the spring gives back no more than
// was put in, whatever the delay of a tick.
TEST(Portal, AHandThatIsLetGoComesToRest) {
  for (const double depth : {0.002, 0.02, 0.06}) {
    PortalRig rig;
    rig.enter(0, depth);
    const double mass = 0.1, grip = 2.0;
    Vec3 p(0.006, 0.003, -depth), v = Vec3::Zero();
    for (int i = 0; i < 50; ++i) rig.at(p);
    Vec3 force = Vec3::Zero();
    double last = 1e9, speed = 0;
    for (int i = 0; i < 3000; ++i) {
      v += 0.001 / mass * (force - grip * v);
      p += 0.001 * v;
      force = rig.at(p, Quat::Identity(), v).force_W;
      speed = std::max(speed, v.norm());
      if (i % 1000 == 999) {
        EXPECT_LT(speed, last);
        last = speed;
        speed = 0;
      }
    }
    EXPECT_LT(v.norm(), 1e-3) << depth;
    EXPECT_TRUE(is_finite(p));
  }
}

// Along a slow closed way the skin takes work and gives none.
TEST(Portal, AClosedWayCostsWork) {
  PortalRig rig;
  rig.params.damping_n_s_per_m = 0;
  rig.enter(0, 0.03);
  double work = 0;
  Vec3 last(0, 0, -0.03);
  for (int i = 0; i <= 8000; ++i) {
    const double a = 2 * std::acos(-1.0) * i / 2000;
    const Vec3 p(0.006 * std::sin(a), 0.004 * std::sin(2 * a), -0.03 + 0.003 * std::sin(3 * a));
    const Vec3 force = rig.at(p).force_W;
    if (i > 2000) work += force.dot(p - last);
    last = p;
  }
  EXPECT_LT(work, 0);
}

TEST(Portal, ASavedStateGoesOnAsItWas) {
  PortalRig rig;
  rig.enter(0, 0.02);
  const auto move = [&](double x) {
    for (int i = 0; i < 200; ++i) rig.at(Vec3(x * i / 200, 1e-5 * i, -0.02 - 1e-5 * i));
    return rig.loop.state_hash();
  };
  move(0.004);
  const auto saved = rig.loop.save();
  const std::uint64_t once = move(-0.003);
  rig.loop.restore(*saved);
  EXPECT_EQ(move(-0.003), once);
}

TEST(Portal, AHandThatIsNotANumberGetsNoForce) {
  PortalRig rig;
  rig.enter(0, 0.02);
  EXPECT_EQ(rig.at(Vec3(std::nan(""), 0, 0)).force_W.norm(), 0);
  EXPECT_TRUE(is_finite(rig.at(Vec3(0.001, 0, -0.02)).force_W));
}

}  // namespace
}  // namespace osteon
