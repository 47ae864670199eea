// Rods in holes of known shape.
#include "osteon/collide/carved_contact.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>

#include "mesh/shapes.h"
#include "osteon/base/random.h"
#include "osteon/collide/field_contact.h"
#include "stepped_hole.h"

namespace osteon {
namespace {

constexpr double kFar = 0.003;
constexpr double kBlock = 0.008;  // half of the cube

struct Bored {
  test::SteppedHole hole;
  CutField cuts = hole.cuts();
  DistanceField bone = std::move(DistanceField::make(test::cube(kBlock)).value());

  CapsuleContact meet(const Capsule& rod) const {
    const FieldView view(bone, &cuts);
    return carved_contact(view, view, rod, kFar);
  }
};

const Bored& bored() {
  static const Bored one;
  return one;
}

// A rod along the hole's axis, moved aside.
Capsule rod_beside(double radius, const Vec3& offset, double tip_z = 0.0035) {
  return {offset + Vec3(0, 0, tip_z + radius), offset + Vec3(0, 0, 0.02), radius};
}

// In the hole, over its rims, in what is left, and far from the cuts.
TEST(FieldView, TheDistanceAloneHasTheSameBitsAndCountsAsALook) {
  std::uint32_t asked = 0, other = 0;
  const FieldView view(bored().bone, &bored().cuts, &asked);
  const FieldView full(bored().bone, &bored().cuts, &other);
  Random random(13);
  for (std::uint32_t i = 1; i <= 3000; ++i) {
    const double far = random.uniform(0, i % 5 == 0 ? 0.03 : 0.004);
    const double height = random.uniform(-0.01, 0.01);
    const Vec3 p = far * random.direction() + Vec3(0, 0, height);
    const FieldSample sample = full.at(p);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(view.distance_at(p)),
              std::bit_cast<std::uint64_t>(sample.distance))
        << p.transpose();
    ASSERT_EQ(asked, i);
    const FieldSample again = view.again(p);
    EXPECT_EQ(asked, i);
    EXPECT_EQ(again.gradient, sample.gradient);
  }
}

TEST(CarvedContact, WhatIsNotFiniteHasNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(bored().meet({Vec3(0, nan, 0), Vec3(0, 0, 0.01), 0.001}).status, LpStatus::kOptimal);
}

TEST(CarvedContact, ExactlyInTheMiddleTheGapIsTheRoomAllRound) {
  const CapsuleContact met = bored().meet(rod_beside(0.0021, Vec3::Zero(), 0.004));
  ASSERT_EQ(met.status, LpStatus::kOptimal);
  EXPECT_NEAR(met.gap, 0.00225 - 0.0021, 1.5e-5);
  EXPECT_NEAR(met.nhat_AB_A.norm(), 1, 1e-9);
  EXPECT_NEAR(met.nhat_AB_A.z(), 0, 0.02);
}

// Beside the middle: R - r - d, and the normal points from the near wall to the axis.
TEST(CarvedContact, BesideTheMiddleTheNearWallIsFound) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const double angle = 6.283 * random.uniform(), d = 0.0003 * random.uniform();
    const double radius = 0.0019 + 0.0004 * random.uniform();
    const Vec3 way(std::cos(angle), std::sin(angle), 0);
    const CapsuleContact met = bored().meet(rod_beside(radius, d * way, 0.0045));
    ASSERT_EQ(met.status, LpStatus::kOptimal);
    EXPECT_NEAR(met.gap, 0.00225 - radius - d, 2.5e-5) << i;
    if (d > 1e-4) {
      EXPECT_LT(met.nhat_AB_A.dot(way), -0.9) << i;
    }
  }
}

// A ball on the axis over the step's round rim: sqrt(narrow^2 + h^2) - r.
TEST(CarvedContact, OverANarrowerHoleTheRimIsMet) {
  constexpr double kRadius = 0.0021, kRoundedRim = 0.00025;
  double last = std::numeric_limits<double>::infinity();
  for (double h = 0.0022; h > 0.0015; h -= 2e-5) {
    const double tip = bored().hole.step_m + h - kRadius;
    const CapsuleContact met = bored().meet(rod_beside(kRadius, Vec3(2e-5, 0, 0), tip));
    ASSERT_EQ(met.status, LpStatus::kOptimal);
    const double beside = 0.00225 - kRadius - 2e-5;
    const double rim = std::hypot(bored().hole.narrow_m, h) - kRadius;
    EXPECT_GT(met.gap, std::min(rim, beside) - 3e-5) << h;
    EXPECT_LT(met.gap, std::min(rim + kRoundedRim, beside + 3e-5)) << h;
    EXPECT_LE(met.gap, last + 5e-6) << "comes nearer, h " << h;
    last = met.gap;
  }
  EXPECT_LT(last, 0);
}

// Steps of a micrometre change a gap by little more, wherever the rod is in the hole.
TEST(CarvedContact, TheGapHasNoJumps) {
  Random random(11);
  for (int i = 0; i < 40; ++i) {
    Vec3 offset = 1e-4 * Vec3(random.uniform() - 0.5, random.uniform() - 0.5, 0);
    const double tip = 0.0024 + 0.006 * random.uniform();
    const Vec3 step = 1e-6 * random.direction();
    double last = bored().meet(rod_beside(0.0021, offset, tip)).gap;
    for (int k = 0; k < 20; ++k) {
      offset += step;
      const double gap = bored().meet(rod_beside(0.0021, offset, tip)).gap;
      EXPECT_NEAR(gap, last, 1e-5) << i << " " << k;
      last = gap;
    }
  }
}

// A rod laid over an edge of the carved block touches with its side: the plane there leaves the
// whole rod in front, however far it reaches beyond the edge.
TEST(CarvedContact, ThePlaneReachesIntoNoPartOfALongRod) {
  Random random(17);
  const auto from_to = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const Vec3 out = Vec3(1, 0, 1).normalized(), down = Vec3(1, 0, -1).normalized();
  for (int i = 0; i < 200; ++i) {
    const double yaw = from_to(-0.6, 0.6), tilt = from_to(-0.3, 0.3), radius = from_to(1e-3, 4e-3);
    const Vec3 level = std::cos(yaw) * down + std::sin(yaw) * Vec3::UnitY();
    const Vec3 along = std::cos(tilt) * level + std::sin(tilt) * out;
    const Vec3 edge(kBlock, from_to(-0.005, 0.005), kBlock);
    const Vec3 middle = edge + (radius + from_to(0, 4e-4)) * out;
    const double before = from_to(0.004, 0.02), after = from_to(0.004, 0.02);
    const Capsule rod{middle - before * along, middle + after * along, radius};
    const CapsuleContact met = bored().meet(rod);
    ASSERT_EQ(met.status, LpStatus::kOptimal);
    ASSERT_LT(met.gap, 0.001) << i;
    const Vec3& n = met.nhat_AB_A;
    const double reaches = n.dot(met.p_axis_A) - std::min(n.dot(rod.p0), n.dot(rod.p1));
    EXPECT_LT(reaches, 1e-6) << i << ": m behind the plane";
    EXPECT_GT(n.dot(out), 0.8) << i;
  }
}

// Far from the hole it is the plain field's contact.
TEST(CarvedContact, FarFromTheHoleItIsThePlainContact) {
  const Capsule rod{Vec3(0.006, 0.005, 0.0095), Vec3(-0.006, 0.006, 0.0097), 0.001};
  const FieldView plain(bored().bone);
  const CapsuleContact want = field_contact(plain, rod, kFar), met = bored().meet(rod);
  EXPECT_NEAR(met.gap, want.gap, 1e-6);
  EXPECT_NEAR((met.nhat_AB_A - want.nhat_AB_A).norm(), 0, 1e-3);
}

}  // namespace
}  // namespace osteon
