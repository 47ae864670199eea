#include "bone/sampled_field.h"

#include <gtest/gtest.h>

#include "osteon/base/random.h"

namespace osteon {
namespace {

Aabb unit_box() {
  Aabb box;
  box.include(Vec3(-0.5, 0, 1));
  box.include(Vec3(0.5, 1, 2));
  return box;
}

double plane(const Vec3& p) { return 2 * p.x() - 3 * p.y() + 0.5 * p.z() + 1; }

// Trilinear interpolation is exact for it.
TEST(SampledField, APlaneIsItself) {
  SampledField field(plane, unit_box(), 0.13);
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p(random.uniform(-0.5, 0.5), random.uniform(0, 1), random.uniform(1, 2));
    EXPECT_NEAR(field(p), plane(p), 1e-12);
  }
}

TEST(SampledField, OutsideItsBoxTheFieldItselfIsAsked) {
  const auto bent = [](const Vec3& p) { return p.squaredNorm(); };
  SampledField field(bent, unit_box(), 0.25);
  for (const Vec3& p : {Vec3(-0.6, 0.33, 1.2), Vec3(0, -0.1, 1.5), Vec3(0.1, 0.2, 9)})
    EXPECT_EQ(field(p), bent(p));
  EXPECT_NEAR(field(Vec3(0.1, 0.3, 1.4)), bent(Vec3(0.1, 0.3, 1.4)), 3 * 0.25 * 0.25 / 4);
  EXPECT_NE(field(Vec3(0.1, 0.3, 1.4)), bent(Vec3(0.1, 0.3, 1.4)));
}

TEST(SampledField, ANodeIsAskedForOnce) {
  int asked = 0;
  const auto counted = [&](const Vec3& p) {
    ++asked;
    return plane(p);
  };
  SampledField field(counted, unit_box(), 0.25);
  EXPECT_EQ(asked, 0);
  field(Vec3(0.1, 0.3, 1.4));
  const int first = asked;
  EXPECT_GT(first, 0);
  EXPECT_LE(first, 8);
  field(Vec3(0.11, 0.31, 1.41));
  EXPECT_EQ(asked, first);
}

}  // namespace
}  // namespace osteon
