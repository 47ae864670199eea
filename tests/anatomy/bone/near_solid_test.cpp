#include "bone/near_solid.h"

#include <gtest/gtest.h>

#include "osteon/base/random.h"

namespace osteon {
namespace {

Vec3 random_point(Random& random, double half) {
  const double x = random.uniform(-half, half);
  const double y = random.uniform(-half, half);
  const double z = random.uniform(-half, half);
  return {x, y, z};
}

Vec3 random_radii(Random& random) {
  return random_point(random, 0.004) + Vec3::Constant(0.006);  // metres, as bones have them
}

Primitive random_primitive(Random& random, int kind) {
  const Vec3 center = random_point(random, 0.01);
  const Mat3 R = random.rotation().toRotationMatrix();
  if (kind == 0) return Ellipsoid{center, random_radii(random), R};
  if (kind == 1) return RoundedBox{center, random_radii(random), 0.001, R};
  if (kind == 2) return HalfSpace{center, random.direction()};
  if (kind == 3) return Crack{center, random.direction(), 0.001, 0.0005, 0.002};
  std::vector<Vec3> points;
  std::vector<double> radii;
  for (int i = 0; i < 4; ++i) {
    points.push_back(random_point(random, 0.02));
    radii.push_back(random.uniform(0.001, 0.006));
  }
  return tube_through(points, radii);
}

int some(Random& random, int count) {
  return std::min(static_cast<int>(random.uniform(0, count)), count - 1);
}

/// An ellipsoid or a tube, to which others are added and from which others are cut.
Solid random_solid(Random& random) {
  Solid solid;
  for (int i = 0; i < 6; ++i) {
    Part part;
    part.operation = i > 3 ? Operation::kCut : Operation::kAdd;
    part.primitive = random_primitive(random, i > 3 ? some(random, 5) : 4 * some(random, 2));
    part.blend = i % 3 == 0 ? 0 : random.uniform(0, 0.004);
    solid.parts.push_back(part);
  }
  return solid;
}

Vec3 point_in(Random& random, const Vicinity& where) {
  return where.center + random.uniform(0, where.radius) * random.direction();
}

Vicinity random_vicinity(Random& random) {
  return {random_point(random, 0.03), random.uniform(0.0002, 0.006)};
}

TEST(NearSolid, NoValueLiesOutsideThePrimitivesSpread) {
  Random random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    const Primitive primitive = random_primitive(random, trial % 5);
    const Vicinity where = random_vicinity(random);
    const Spread values = spread(primitive, where);
    for (int i = 0; i < 20; ++i) {
      const double d = distance(primitive, point_in(random, where));
      EXPECT_GE(d, values.least) << "kind " << trial % 5;
      EXPECT_LE(d, values.most) << "kind " << trial % 5;
    }
  }
}

/// Long and flat, small and large vicinities, about the middle and across the surface.
TEST(NearSolid, NoValueLiesOutsideTheSpreadOfALongEllipsoid) {
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    Ellipsoid e;
    e.radii = {random.uniform(0.001, 0.02), random.uniform(0.001, 0.02), 0.001};
    const Vicinity where{random_point(random, 0.02), random.uniform(1e-5, 0.01)};
    const Spread values = spread(e, where);
    for (int i = 0; i < 30; ++i) {
      const double d = distance(e, point_in(random, where));
      EXPECT_GE(d, values.least);
      EXPECT_LE(d, values.most);
    }
  }
}

/// Near the surface a small place has a small spread.
TEST(NearSolid, SpreadsAreNarrowWhereTheyMatter) {
  const Ellipsoid e{Vec3::Zero(), Vec3(0.008, 0.006, 0.004), Mat3::Identity()};
  const Vicinity where{Vec3(0.008, 0, 0), 0.0005};
  const Spread values = spread(e, where);
  EXPECT_GT(values.least, -0.001);
  EXPECT_LT(values.most, 0.001);
  EXPECT_EQ(values.sign(), 0);
  EXPECT_EQ(spread(e, {Vec3(0.012, 0, 0), 0.001}).sign(), 1);
  EXPECT_EQ(spread(e, {Vec3(0.004, 0, 0), 0.001}).sign(), -1);
}

TEST(NearSolid, NarrowedTwiceItsValuesAreTheSolidsBitByBit) {
  Random random(7);
  int signs = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Solid solid = random_solid(random);
    const NearSolid whole(solid);
    const Vicinity wide = random_vicinity(random);
    const Vicinity tight{wide.center + 0.5 * wide.radius * random.direction(), 0.5 * wide.radius};
    Spread in_wide, in_tight;
    const NearSolid near = whole.within(wide, in_wide);
    const NearSolid nearer = near.within(tight, in_tight);
    signs += in_tight.sign() != 0 ? 1 : 0;
    for (int i = 0; i < 40; ++i) {
      const Vec3 p = point_in(random, wide), q = point_in(random, tight);
      EXPECT_EQ(whole(p), distance(solid, p));
      EXPECT_EQ(near(p), distance(solid, p));
      EXPECT_EQ(nearer(q), distance(solid, q));
      EXPECT_GE(near(p), in_wide.least);
      EXPECT_LE(near(p), in_wide.most);
      EXPECT_GE(nearer(q), in_tight.least);
      EXPECT_LE(nearer(q), in_tight.most);
    }
  }
  EXPECT_GT(signs, 250) << "the signs of most places should be known";
}

}  // namespace
}  // namespace osteon
