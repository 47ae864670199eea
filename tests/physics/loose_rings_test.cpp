#include "osteon/physics/loose_rings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ring_box.h"

namespace osteon {
namespace {

using testing::jaws_at_ring;
using testing::kRingLies_m;
using testing::ring_box;

constexpr double kRingStep_s = 0.002;
const Vec3 kOnFirst(0, 0, kRingLies_m);

struct RingRig {
  explicit RingRig(std::shared_ptr<const Case> c = ring_box()) : rings(std::move(c), kRingStep_s) {}
  Vec3 at(std::size_t ring = 0) const { return rings.motion(ring).X_WB.p; }
  LooseRing::Is is(std::size_t ring = 0) const { return rings.state().rings[ring].is; }
  void step(const ToolState& a) {
    const ToolState* const tools[] = {&a};
    rings.step(tools, 0);
  }
  void step(const ToolState& a, const ToolState& b) {
    const ToolState* const tools[] = {&a, &b};
    rings.step(tools, 0);
  }
  // Jaws about the first ring, which lies on the first peg.
  void grasp() {
    step(jaws_at_ring(kOnFirst, 1));
    step(jaws_at_ring(kOnFirst, 0));
  }
  // The held ring's middle goes to `to`, in steps of 0.1 mm.
  void carry(const Vec3& to) {
    const Vec3 from = at();
    const int n = std::max(1, static_cast<int>((to - from).norm() / 0.0001));
    for (int k = 1; k <= n; ++k) step(jaws_at_ring(from + (to - from) * (double(k) / n), 0));
  }
  void open_and_wait(const Vec3& center, int steps = 300) {
    for (int n = 0; n < steps; ++n) step(jaws_at_ring(center, 1));
  }
  LooseRings rings;
};

TEST(Rings, AreFoundByNameWhereThereArePegs) {
  const auto box = ring_box();
  const RingSet set = find_rings(*box);
  ASSERT_EQ(set.rings.size(), 2u);
  ASSERT_EQ(set.pegs.size(), 2u);
  EXPECT_NEAR(set.rings[0].middle_m, 0.005, 1e-9);
  EXPECT_NEAR(set.rings[0].thick_m, 0.002, 1e-9);
  EXPECT_NEAR(set.pegs[1].radius_m, 0.002, 1e-9);
  EXPECT_NEAR(set.pegs[1].top_W.x(), 0.03, 1e-9);
  EXPECT_TRUE(is_loose_ring(*box, 5));
  EXPECT_FALSE(is_loose_ring(*box, 0));
  EXPECT_FALSE(is_loose_ring(*box, 99));
  Case hand = *box;  // a finger has no pegs
  for (Bone& bone : hand.bones)
    if (bone.name.starts_with("peg_")) bone.name = "finger";
  EXPECT_TRUE(find_rings(hand).rings.empty());
  EXPECT_FALSE(is_loose_ring(hand, 5));
  hand.bones[5].name = "ring_phalanx";
  hand.bones[1].name = "peg_1";
  EXPECT_FALSE(is_loose_ring(hand, 5));
}

TEST(Rings, LieStillUntilJawsShutAboutThem) {
  RingRig rig;
  for (int n = 0; n < 100; ++n) rig.step(jaws_at_ring(kOnFirst, n % 2 ? 1.0 : 0.5));
  EXPECT_EQ(rig.at(), kOnFirst);
  EXPECT_EQ(rig.rings.motion(0).v_W, Vec3(Vec3::Zero()));
  // Shut from the beginning: jaws must have been open first.
  RingRig shut;
  for (int n = 0; n < 10; ++n) shut.step(jaws_at_ring(kOnFirst, 0));
  EXPECT_EQ(shut.is(), LooseRing::Is::kResting);
}

TEST(Rings, AreMissedByJawsBesideThemAndByJawsThatShutAlongThem) {
  RingRig far;
  const Vec3 beside = kOnFirst + Vec3(-0.004, 0, 0);
  far.step(jaws_at_ring(beside, 1));
  far.step(jaws_at_ring(beside, 0));
  EXPECT_EQ(far.is(), LooseRing::Is::kResting);
  RingRig turned;
  for (const double jaw : {1.0, 0.0}) {
    ToolState tool = jaws_at_ring(kOnFirst, jaw);
    tool.X_WP.q = tool.X_WP.q * Quat(std::sqrt(0.5), 0, 0, std::sqrt(0.5));  // about the shaft
    turned.step(tool);
  }
  EXPECT_EQ(turned.is(), LooseRing::Is::kResting);
}

// The closed form of a free fall tells when it lands.
TEST(Rings, AreCarriedToAnotherPegAndFallOntoItsShoulder) {
  RingRig rig;
  rig.grasp();
  ASSERT_EQ(rig.is(), LooseRing::Is::kHeld);
  rig.carry({0, 0, 0.020});
  rig.carry({0.03, 0, 0.020});
  EXPECT_NEAR((rig.at() - Vec3(0.03, 0, 0.020)).norm(), 0, 1e-9);
  EXPECT_GT(rig.rings.motion(0).v_W.norm(), 0);
  const double fall_s = std::sqrt(2 * (0.020 - kRingLies_m) / 9.81);
  const int until = static_cast<int>(fall_s / kRingStep_s);
  rig.open_and_wait({0.03, 0, 0.020}, until - 3);
  EXPECT_EQ(rig.is(), LooseRing::Is::kFalling);
  rig.open_and_wait({0.03, 0, 0.020}, 6);
  EXPECT_EQ(rig.is(), LooseRing::Is::kResting);
  EXPECT_NEAR((rig.at() - Vec3(0.03, 0, kRingLies_m)).norm(), 0, 1e-6);
  EXPECT_TRUE(peg_in_ring(find_rings(*ring_box()), find_rings(*ring_box()).rings[0], rig.at()));
}

TEST(Rings, DroppedBetweenThePegsLieOnTheFloorAndCanBeTakenAgain) {
  RingRig rig;
  rig.grasp();
  rig.carry({0, 0, 0.020});
  rig.carry({0.015, 0, 0.020});
  rig.open_and_wait({0.015, 0, 0.020});
  EXPECT_NEAR((rig.at() - Vec3(0.015, 0, 0.001)).norm(), 0, 1e-6);
  rig.step(jaws_at_ring(rig.at(), 1));
  rig.step(jaws_at_ring(rig.at(), 0));
  EXPECT_EQ(rig.is(), LooseRing::Is::kHeld);
}

TEST(Rings, LetGoOverTheEdgeOfAPegSlideOffItAndNeverHangOnItsTop) {
  for (const double off : {0.0, 0.0025, 0.0045, 0.005, 0.0065, 0.009}) {
    RingRig rig;
    rig.grasp();
    rig.carry({0, 0, 0.020});
    rig.carry({0.03 - off, 0, 0.020});
    rig.open_and_wait({0.03 - off, 0, 0.020});
    EXPECT_EQ(rig.is(), LooseRing::Is::kResting) << off;
    EXPECT_LT(rig.at().z(), 0.0075) << off;
    // The hole is about the peg, or the ring is clear of it.
    const double from_peg = std::abs(rig.at().x() - 0.03);
    EXPECT_TRUE(from_peg < 0.0021 || from_peg > 0.0079) << off << " " << from_peg;
  }
}

TEST(Rings, GiveWayToAPegAndSlipOutOfJawsThatPullOn) {
  RingRig rig;
  rig.grasp();
  rig.carry({0.0015, 0, kRingLies_m});  // the play in the hole
  EXPECT_NEAR(rig.at().x(), 0.0015, 1e-9);
  rig.carry({0.003, 0, kRingLies_m});
  EXPECT_EQ(rig.is(), LooseRing::Is::kHeld);
  EXPECT_LT(rig.at().x(), 0.0021);
  for (int n = 0; n < 60; ++n) rig.step(jaws_at_ring(Vec3(0.003 + 0.0001 * n, 0, kRingLies_m), 0));
  EXPECT_EQ(rig.is(), LooseRing::Is::kResting);
  EXPECT_LT(rig.at().x(), 0.0021);
}

TEST(Rings, GoFromHandToHand) {
  RingRig rig;
  const Vec3 up(0, 0, 0.020);
  ToolState left = jaws_at_ring(kOnFirst, 1), right = jaws_at_ring(kOnFirst, 1);
  const auto other_side = [](const Vec3& center, double jaw) {
    ToolState tool = jaws_at_ring(Vec3::Zero(), jaw);
    const Quat half(0, 0, 0, 1);  // half a turn about z
    tool.X_WP = {half * tool.X_WP.p + center, half * tool.X_WP.q};
    return tool;
  };
  right = other_side(up, 1);
  rig.step(left, right);
  left.jaw = 0;
  rig.step(left, right);
  ASSERT_EQ(rig.rings.state().rings[0].hand, 0);
  left = jaws_at_ring(up, 0);
  rig.step(left, right);
  right.jaw = 0;
  rig.step(left, right);
  EXPECT_EQ(rig.rings.state().rings[0].second, 1);
  left.jaw = 1;
  rig.step(left, right);
  EXPECT_EQ(rig.rings.state().rings[0].hand, 1);
  EXPECT_EQ(rig.is(), LooseRing::Is::kHeld);
  right = other_side(up + Vec3(0.01, 0, 0), 0);
  rig.step(left, right);
  EXPECT_NEAR((rig.at() - up - Vec3(0.01, 0, 0)).norm(), 0, 1e-9);
  // Who took it over first loses it if the jaws come away before they lead.
  right.jaw = 1;
  for (int n = 0; n < 300; ++n) rig.step(left, right);
  EXPECT_EQ(rig.is(), LooseRing::Is::kResting);
}

TEST(Rings, LieOnOneAnother) {
  RingRig rig(ring_box({0.03, 0, kRingLies_m}));
  rig.grasp();
  rig.carry({0, 0, 0.020});
  rig.carry({0.03, 0, 0.020});
  rig.open_and_wait({0.03, 0, 0.020});
  EXPECT_NEAR(rig.at(0).z(), kRingLies_m + 0.002, 1e-6);
  EXPECT_NEAR(rig.at(1).z(), kRingLies_m, 1e-9);
}

TEST(Rings, AnotherInstrumentAnotherEpochAndNoPoseTakeNothing) {
  RingRig rig;
  rig.step(jaws_at_ring(kOnFirst, 1));
  ToolState other = jaws_at_ring(kOnFirst, 0);
  other.instrument = 3;
  rig.step(other);  // jaws are shut as it is taken
  EXPECT_EQ(rig.is(), LooseRing::Is::kResting);
  RingRig late;
  for (const double jaw : {1.0, 0.0}) {
    ToolState tool = jaws_at_ring(kOnFirst, jaw);
    tool.epoch = 1;
    late.step(tool);
  }
  EXPECT_EQ(late.is(), LooseRing::Is::kResting);
  RingRig lost;
  for (const double jaw : {1.0, 0.0}) {
    ToolState tool = jaws_at_ring(kOnFirst, jaw);
    tool.X_WP.p.x() = std::nan("");
    lost.step(tool);
  }
  EXPECT_EQ(lost.is(), LooseRing::Is::kResting);
  EXPECT_TRUE(is_finite(lost.at()));
}

TEST(Rings, GoBackToAMomentAndFallWhereTheyWereHeldThen) {
  RingRig rig;
  rig.grasp();
  rig.carry({0, 0, 0.020});
  rig.carry({0.015, 0, 0.020});
  const RingsState kept = rig.rings.state();
  const std::uint64_t hash = rig.rings.hash();
  rig.carry({0.03, 0, 0.020});
  EXPECT_NE(rig.rings.hash(), hash);
  rig.rings.restore(kept);
  EXPECT_EQ(rig.rings.hash(), hash);
  rig.rings.go_back(kept);
  EXPECT_EQ(rig.is(), LooseRing::Is::kFalling);
  for (int n = 0; n < 300; ++n) rig.step(jaws_at_ring({0.03, 0, 0.020}, 0));
  EXPECT_NEAR((rig.at() - Vec3(0.015, 0, 0.001)).norm(), 0, 1e-6);
  EXPECT_FALSE(rig.rings.fits(RingsState{}));
  RingsState odd = kept;
  odd.rings[0].hand = 7;
  EXPECT_FALSE(rig.rings.fits(odd));
  odd = kept;
  odd.rings[1].X_WB.p.y() = std::nan("");
  EXPECT_FALSE(rig.rings.fits(odd));
}

}  // namespace
}  // namespace osteon
