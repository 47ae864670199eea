// A hundred thousand random cuts of a meniscus and of a stump.
#include "physics/soft/random_solid_cuts.h"

namespace osteon {
namespace {

TEST(SolidManyCuts, StayClosedAndKeepTheirVolumeAfterEach) {
  testing::expect_sound_after_random_solid_cuts<testing::GridCutRig>(100000, 11);
}

TEST(SolidManyCuts, OfInstrumentsThatAreLedThroughStayClosedAndKeepTheirVolume) {
  testing::expect_sound_after_random_solid_cuts<testing::PassCutRig>(2000, 11);
}

}  // namespace
}  // namespace osteon
