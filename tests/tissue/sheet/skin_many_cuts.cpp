// A hundred thousand random cuts.
#include "tissue/sheet/random_cuts.h"

namespace osteon {
namespace {

TEST(SkinManyCuts, StaysAManifoldOfTheSameAreaAfterEach) {
  expect_sound_after_random_cuts(2000, 11);
}

}  // namespace
}  // namespace osteon
