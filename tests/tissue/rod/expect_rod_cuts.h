#pragma once

#include <gtest/gtest.h>

#include <cstdio>

#include "osteon/base/random.h"
#include "tissue/rod/random_rod_cuts.h"

namespace osteon::testing {

/// Twelve cuts in each of so many rods.
inline void expect_sound_after_random_rod_cuts(int cuts, std::uint64_t seed) {
  Random random(seed);
  const RandomRodCuts::Numbers next = [&random] { return random.uniform(-1, 1); };
  RandomRodCuts rods;
  int done = 0, made = 0;
  while (done < cuts && !::testing::Test::HasFailure()) {
    if (!rods.begin(next)) continue;
    ++made;
    for (int i = 0; i < 12 && done < cuts && rods.can_cut(); ++i, ++done)
      ASSERT_EQ(rods.cut(next), "") << "cut " << done;
  }
  std::printf("%d cuts of %d rods\n", done, made);
}

}  // namespace osteon::testing
