// Random cuts of a meniscus and of a stump, of the grid alone and by instruments that are led
// through; a hundred thousand of them in solid_many_cuts.cpp.
#include "physics/soft/random_solid_cuts.h"

namespace osteon {
namespace {

// In one test: they share the stiffness of the whole.
TEST(SolidRandomCuts, StayClosedAndKeepTheirVolumeAfterEach) {
  testing::expect_sound_after_random_solid_cuts<testing::GridCutRig>(60, 7);
  testing::expect_sound_after_random_solid_cuts<testing::PassCutRig>(12, 7);
}

}  // namespace
}  // namespace osteon
