#include "runs/pictures/xray_tally.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(XrayTally, NothingIsGivenBeforeTheFirstPicture) {
  const XrayTally total;
  EXPECT_EQ(total.dose.shots, 0);
  EXPECT_EQ(total.dose.air_kerma_mgy, 0);
  EXPECT_EQ(total.hands, 0u);
}

TEST(XrayTally, SumsWhatEveryPictureGaveAndToWhichHand) {
  XrayTally total;
  HandDose near, far;
  near.direct_mgy = 0.25;
  near.scattered_mgy = 0.5;
  far.scattered_mgy = 0.125;
  total.add({0.5, 100, 200, 0.01, 1}, {near, far});
  total.add({0.25, 50, 180, 0.02, 2}, {near});
  EXPECT_EQ(total.dose.air_kerma_mgy, 0.75);
  EXPECT_EQ(total.dose.kerma_area_mgy_cm2, 150);
  EXPECT_EQ(total.dose.beam_area_cm2, 180);
  EXPECT_DOUBLE_EQ(total.dose.seconds, 0.03);
  EXPECT_EQ(total.dose.shots, 3);
  EXPECT_EQ(total.hands, 2u);
  EXPECT_EQ(total.hands_mgy[0], 1.5);
  EXPECT_EQ(total.hands_mgy[1], 0.125);
}

TEST(XrayTally, MoreHandsThanThereCanBeAreNotCounted) {
  XrayTally total;
  total.add({}, std::vector<HandDose>(kMaxHands + 3));
  EXPECT_EQ(total.hands, kMaxHands);
}

TEST(XrayTally, DosesAreWrittenWithThreeDigitsInTheUnitThatFits) {
  EXPECT_EQ(dose_words(0), "0.00 \xC2\xB5Gy");
  EXPECT_EQ(dose_words(0.001234), "1.23 \xC2\xB5Gy");
  EXPECT_EQ(dose_words(0.009996), "10.0 \xC2\xB5Gy");
  EXPECT_EQ(dose_words(0.0749), "74.9 \xC2\xB5Gy");
  EXPECT_EQ(dose_words(0.9994), "999 \xC2\xB5Gy");
  EXPECT_EQ(dose_words(0.9996), "1.00 mGy");
  EXPECT_EQ(dose_words(12.34), "12.3 mGy");
}

}  // namespace
}  // namespace osteon
