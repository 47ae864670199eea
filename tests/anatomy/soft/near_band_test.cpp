#include "soft/near_band.h"

#include <gtest/gtest.h>

#include "osteon/base/random.h"

namespace osteon {
namespace {

/// Bent, twisted and widening, wider than thick at one end and thicker than wide at the other.
LaidBand twisted_band() {
  LaidBand band;
  for (int i = 0; i <= 12; ++i) {
    const double t = i / 12.0;
    const Mat3 R = rotation_xyz_deg({90 * t, 20 * t, 60 * t});
    BandSection s;
    s.center = Vec3(0.02 * t, 0.008 * t * t, 0.003 * t * (1 - t));
    s.along = R.col(0);
    s.across = R.col(1);
    s.flat = R.col(2);
    s.half_width = 0.003 - 0.0022 * t;
    s.half_thickness = 0.0006 + 0.0004 * t;
    band.sections.push_back(s);
  }
  return band;
}

TEST(NearBandSpans, NarrowedTwiceItsValuesAreTheBandsBitByBit) {
  const LaidBand band = twisted_band();
  const NearBandSpans whole(band);
  Random random(5);
  int outside = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Vec3 share(random.uniform(-0.3, 1.3), random.uniform(-0.5, 1.5), random.uniform(-1, 1));
    const Vicinity wide{Vec3(0.02, 0.008, 0.006).cwiseProduct(share), random.uniform(1e-4, 4e-3)};
    const Vicinity tight{wide.center + 0.5 * wide.radius * random.direction(), 0.5 * wide.radius};
    Spread in_wide, in_tight;
    const NearBandSpans near = whole.within(wide, in_wide), nearer = near.within(tight, in_tight);
    outside += in_tight.sign() > 0 ? 1 : 0;
    for (int i = 0; i < 30; ++i) {
      const Vec3 p = wide.center + random.uniform(0, wide.radius) * random.direction();
      const Vec3 q = tight.center + random.uniform(0, tight.radius) * random.direction();
      EXPECT_EQ(whole(p), distance(band, p));
      EXPECT_EQ(near(p), distance(band, p));
      EXPECT_EQ(nearer(q), distance(band, q));
      EXPECT_GE(near(p), in_wide.least);
      EXPECT_LE(near(p), in_wide.most);
      EXPECT_GE(nearer(q), in_tight.least);
      EXPECT_LE(nearer(q), in_tight.most);
    }
  }
  EXPECT_GT(outside, 500) << "most places should be known to lie outside";
}

}  // namespace
}  // namespace osteon
