#include "window/controllers/views/moving_detail.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(MovingDetail, OneSlowPictureChangesNothing) {
  MovingDetail detail;
  for (int k = 0; k < 5; ++k) {
    detail.took(0.2);
    detail.took(0.02);
  }
  EXPECT_EQ(detail.share(), 1);
}

TEST(MovingDetail, SlowPicturesGetCoarserToALimit) {
  MovingDetail detail;
  double before = detail.share();
  for (int step = 0; step < 5; ++step) {
    detail.took(0.07);
    detail.took(0.07);
    EXPECT_LT(detail.share(), before);
    before = detail.share();
  }
  for (int k = 0; k < 20; ++k) detail.took(1);
  EXPECT_EQ(detail.share(), 0.33);
}

TEST(MovingDetail, QuickOnesGetFinerAgain) {
  MovingDetail detail;
  for (int k = 0; k < 20; ++k) detail.took(0.07);
  for (int k = 0; k < 20; ++k) detail.took(0.005);
  EXPECT_EQ(detail.share(), 1);
}

// The work is a fixed part and one by the pixel: whatever they are, detail comes to rest.
TEST(MovingDetail, SettlesWhateverAPictureCosts) {
  for (double fixed_s = 0.001; fixed_s < 0.02; fixed_s += 0.001) {
    for (double pixels_s = 0.001; pixels_s < 0.2; pixels_s *= 1.3) {
      MovingDetail detail;
      const auto run = [&](int pictures) {
        int changes = 0;
        for (int k = 0; k < pictures; ++k) {
          const double share = detail.share();
          detail.took(fixed_s + pixels_s * share * share);
          if (detail.share() != share) ++changes;
        }
        return changes;
      };
      run(40);
      EXPECT_EQ(run(40), 0) << fixed_s << " " << pixels_s;
    }
  }
}

}  // namespace
}  // namespace osteon
