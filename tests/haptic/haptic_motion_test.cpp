// Bones that move, restless hands, and going on from a saved state.
#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"
#include "osteon/haptic/haptic.h"
#include "osteon/haptic/snapshot_age.h"
#include "test_scene.h"

namespace osteon {
namespace {

using test::bone_of;
using test::box_hull;
using test::floor_bone;
using test::go;
using test::proxy_gap;
using test::Rig;
using test::tip_reach;

TEST(HapticLoop, AMovingBonePushesTheProxyAndTheHandFeelsIt) {
  Rig rig({floor_bone()});
  const double z = tip_reach(rig) + 0.0001;
  rig.at(Vec3(0, 0, z));
  for (int i = 1; i <= 100; ++i) {  // the floor rises by 10 mm/s
    rig.bones.bones[0].X_WB.p.z() = 1e-5 * i;
    const ToolState& s = rig.at(Vec3(0, 0, z));
    ASSERT_GT(proxy_gap(rig, s), 0);
    const double depth = 1e-5 * i - 0.0001;
    ASSERT_NEAR(s.force_W.z(), 2000 * std::max(0.0, depth), 0.01) << i;
  }
}

TEST(HapticLoop, AFastPlateDoesNotOverrunTheProxy) {
  // 0.5 mm thick, 2 mm in one tick: past the whole tip.
  Rig rig({bone_of({box_hull(Vec3(0.02, 0.02, 0.00025))})});
  rig.at(Vec3(0, 0, 0.0012));
  rig.bones.bones[0].X_WB.p.z() = 0.003;
  for (int i = 0; i < 5; ++i) {
    const ToolState& s = rig.at(Vec3(0, 0, 0.0012));
    ASSERT_GT(s.X_WP.p.z(), 0.00325);
    ASSERT_GT(proxy_gap(rig, s), 0);
    ASSERT_GT(s.force_W.z(), 1);
  }
}

TEST(HapticLoop, BonesAreCarriedForwardByTheirAge) {
  Rig rig({floor_bone()});
  const double z = tip_reach(rig);
  rig.at(Vec3(0, 0, z + 0.0001));
  rig.bones.bones[0].v_W = Vec3(0, 0, 0.1);
  ToolInput input;
  input.X_WD.p = Vec3(0, 0, z + 0.0001);
  const ToolState& s = rig.loop.tick(input, rig.bones, 0.002, rig.params);
  EXPECT_NEAR(s.force_W.z(), 2000 * 0.0001, 0.01);  // 0.2 mm up, less the 0.1 mm of room
}

// The floor rises by 0.1 m/s under a tip 0.1 mm above it: by 2 mm in the longest time counted.
TEST(HapticLoop, BonesAreCarriedForwardNoFartherThanTheOldestSnapshot) {
  const auto force_n = [](double age_s) {
    Rig rig({floor_bone()});
    ToolInput input;
    input.X_WD.p = Vec3(0, 0, tip_reach(rig) + 0.0001);
    rig.at(input.X_WD.p);
    rig.bones.bones[0].v_W = Vec3(0, 0, 0.1);
    return rig.loop.tick(input, rig.bones, age_s, rig.params).force_W.z();
  };
  EXPECT_NEAR(force_n(kOldestSnapshot_s), 2000 * (0.1 * kOldestSnapshot_s - 0.0001), 0.01);
  EXPECT_LT(force_n(0.5 * kOldestSnapshot_s), force_n(kOldestSnapshot_s) - 1);
  for (const double age_s : {0.05, 10.0}) EXPECT_EQ(force_n(age_s), force_n(kOldestSnapshot_s));
}

TEST(HapticLoop, AStuckProxyRidesOnItsBone) {
  Rig rig({floor_bone({1e4, 0.5, 0.3})});
  const double z = tip_reach(rig) - 0.001;
  rig.at(Vec3(0, 0, 0.003));
  go(rig, Vec3(0, 0, 0.003), Vec3(0, 0, z), 50);
  for (int i = 1; i <= 20; ++i) {
    rig.bones.bones[0].X_WB.p.x() = 1e-5 * i;
    const ToolState& s = rig.at(Vec3(0, 0, z));
    ASSERT_TRUE(s.status & kTickSticking);
    ASSERT_NEAR(s.X_WP.p.x(), 1e-5 * i, 1e-9);
    ASSERT_NEAR(s.force_W.x(), 2000 * 1e-5 * i, 1e-4);
  }
}

TEST(HapticLoop, PinchedBetweenBonesItReportsAndRecovers) {
  Rig rig({bone_of({box_hull(Vec3(0.02, 0.02, 0.005), Vec3(0, 0, -0.007))}),
           bone_of({box_hull(Vec3(0.02, 0.02, 0.005), Vec3(0, 0, 0.007))})});
  rig.at(Vec3::Zero());
  bool blocked = false;
  for (int i = 0; i < 400; ++i) {  // the jaws close to 1 mm, narrower than the tip, and open again
    const double closed = 1e-5 * (i < 200 ? i : 400 - i) * 0.75;
    rig.bones.bones[0].X_WB.p.z() = closed;
    rig.bones.bones[1].X_WB.p.z() = -closed;
    const ToolState& s = rig.at(Vec3::Zero());
    blocked = blocked || (s.status & kTickProxyBlocked);
    ASSERT_TRUE(is_finite(s.X_WP));
    ASSERT_LT(s.force_W.norm(), 5);
    ASSERT_LT(std::abs(s.X_WP.p.z()), 0.002);
  }
  EXPECT_TRUE(blocked);
  const ToolState& s = rig.at(Vec3::Zero());
  EXPECT_EQ(s.status & kTickProxyBlocked, 0u);
  EXPECT_EQ(s.X_WP.p, Vec3(Vec3::Zero()));
}

// Boxes of all sizes and turns, overlapping and apart.
std::vector<Bone> clutter(Random& random, int count) {
  std::vector<Bone> bones;
  for (int i = 0; i < count; ++i) {
    const double a = random.uniform(0.001, 0.006);
    const double b = random.uniform(0.0002, 0.006);
    const double c = random.uniform(0.001, 0.006);
    const Vec3 dir = random.direction();
    const double far = random.uniform(0.0115, 0.015);  // the middle is free
    const double friction = random.uniform(0, 0.6);
    Pose X_WB;
    X_WB.p = far * dir;
    X_WB.q = random.rotation();
    bones.push_back(bone_of({box_hull(Vec3(a, b, c))}, X_WB, {1e4, friction, 0.7 * friction}));
  }
  return bones;
}

TEST(HapticLoop, ARestlessHandNeverDrivesTheProxyIntoBone) {
  double largest_gap = 0;
  int contacts = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    Random random(seed);
    Rig rig(clutter(random, 12));
    Vec3 p(0, 0, 0);
    Vec3 goal(0, 0, 0);
    Quat q = Quat::Identity();
    rig.at(p);
    for (int i = 0; i < 300; ++i) {
      if (i % 60 == 0) {
        const double far = random.uniform(0.005, 0.018);
        goal = far * random.direction();
      }
      const Vec3 dir = random.direction();
      const bool leap = random.uniform() < (seed % 2 ? 0.05 : 0.0);
      p += 0.0003 * (goal - p).normalized() + (leap ? 0.01 : 0.0001) * dir;
      if (p.norm() > 0.02) p *= 0.5;
      if (random.uniform() < 0.1) q = random.rotation();
      const ToolState& s = rig.at(p, q);
      const double gap = proxy_gap(rig, s);
      ASSERT_GT(gap, 0) << seed << " " << i << " " << s.status << " " << rig.loop.save()->armed;
      ASSERT_EQ(s.status & (kTickSolverLimit | kTickProxyBlocked | kTickForceNotFinite), 0u);
      contacts += s.contact_count > 0;
      if (s.contact_count && seed % 2 == 0) largest_gap = std::max(largest_gap, gap);
    }
  }
  EXPECT_GT(contacts, 250);
  // What is felt is touched, but for the glide from facet to facet.
  EXPECT_LT(largest_gap, 5e-4);
}

TEST(HapticLoop, RestoredItGoesOnWithTheSameBits) {
  Random random(9);
  Rig rig(clutter(random, 10));
  rig.params = HapticParams{};
  std::vector<ToolInput> inputs;
  Vec3 p(0, 0, 0);
  for (int i = 0; i < 1500; ++i) {
    const Vec3 dir = random.direction();
    p += 0.0003 * dir;
    if (p.norm() > 0.018) p *= 0.5;
    ToolInput input;
    input.X_WD.p = p;
    if (i % 200 == 0) input.X_WD.q = random.rotation();
    input.v_W = 0.3 * dir;
    inputs.push_back(input);
  }
  const auto run = [&](int from, int to) {
    std::vector<std::uint64_t> hashes;
    for (int i = from; i < to; ++i) {
      rig.bones.bones[3].X_WB.p.x() += 1e-6;
      rig.loop.tick(inputs[i], rig.bones, 0.001, rig.params);
      hashes.push_back(rig.loop.state_hash());
    }
    return hashes;
  };
  run(0, 1000);
  const auto saved = rig.loop.save();
  const BoneSnapshot bones = rig.bones;
  const auto first = run(1000, 1500);
  rig.loop.restore(*saved);
  rig.bones = bones;
  EXPECT_EQ(run(1000, 1500), first);
  // The hash sees a difference in the last bit of one input.
  rig.loop.restore(*saved);
  rig.bones = bones;
  inputs[1200].X_WD.p.x() = std::nextafter(inputs[1200].X_WD.p.x(), 1.0);
  const auto third = run(1000, 1500);
  EXPECT_EQ(third[199], first[199]);
  EXPECT_NE(third[200], first[200]);
}

}  // namespace
}  // namespace osteon
