// A band that an instrument presses at its very end, or is drawn there.
#include "osteon/scene/soft_band.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

// Some hundred newtons from bone to bone, askew, so that places on it are rounded.
SoftBand tight_band() {
  SoftBand band;
  band.radius_m = 0.003;
  band.fibres = {{0.027, 9000, 0.01}};
  return band;
}

const BandSpan kAskew{{0.0107, -0.0131, 0.0173}, {0.0301, 0.0053, 0.0061}};

// Beside either end and beyond it, where the nearest point of the band is the end but for rounding.
TEST(SoftBand, PressedAtItsEndsItPushesNoHarderThanItsSurfaceYields) {
  const SoftBand band = tight_band();
  const Vec3 way = (kAskew.b_W - kAskew.a_W).normalized();
  Random random(5);
  int pressed = 0, beside = 0;
  for (int n = 0; n < 20000; ++n) {
    const auto some = [&](double most) {
      return Vec3(random.uniform(-most, most), random.uniform(-most, most),
                  random.uniform(-most, most));
    };
    const BandSpan span{kAskew.a_W + some(0.0005), kAskew.b_W + some(0.0005)};
    const Vec3 end = n % 2 == 0 ? span.a_W : span.b_W;
    const Vec3 middle = end + some(0.004), along = some(1).normalized();
    const Capsule shaft{middle - 0.03 * along, middle + 0.03 * along, 0.0015};
    const BandContact contact{0, 0, way.cross(some(1)).normalized(), 0};
    const BandPress press = press_band(band, span, round_box(shaft), contact, 800);
    if (!press.presses) continue;
    ++pressed;
    if (press.force_n > 0.1) ++beside;
    ASSERT_LE(press.force_n, 1.001 * 800 * press.deep_m) << n;
    ASSERT_GE(press.force_n, 0) << n;
  }
  EXPECT_GT(pressed, 2000);
  EXPECT_GT(beside, 200) << "beside the end it is felt";
}

TEST(SoftBand, DrawnAtItsEndsItPullsNoHarderThanTheSpring) {
  const SoftBand band = tight_band();
  Random random(6);
  int drawn = 0;
  for (int n = 0; n < 20000; ++n) {
    const double share = std::pow(10, random.uniform(-18, -1));
    const Vec3 way = kAskew.b_W - kAskew.a_W;
    const Vec3 to_W = kAskew.a_W + share * way + random.uniform(0.004, 0.01) * way.unitOrthogonal();
    const BandPress press = draw_band(band, kAskew, to_W, 0, 1000);
    if (!press.presses) continue;
    ++drawn;
    ASSERT_LE(press.force_n, 1.001 * 1000 * press.deep_m) << n;
  }
  EXPECT_GT(drawn, 10000);
}

}  // namespace
}  // namespace osteon
