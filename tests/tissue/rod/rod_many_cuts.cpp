// A hundred thousand random cuts of rods.
#include "tissue/rod/expect_rod_cuts.h"

namespace osteon {
namespace {

TEST(RodManyCuts, KeepMassLengthAndMomentumAndAllPartsMoveOn) {
  testing::expect_sound_after_random_rod_cuts(100000, 11);
}

}  // namespace
}  // namespace osteon
