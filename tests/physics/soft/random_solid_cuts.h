#pragma once

#include <gtest/gtest.h>

#include <cstdio>

#include "osteon/base/random.h"
#include "physics/soft/grid_cut_rig.h"
#include "physics/soft/pass_cut_rig.h"

namespace osteon::testing {

/// So many cuts that took something, fifty in a solid before it is made whole: after each the
/// surface is closed, after some it holds what is left, and the stiffness is sound.
template <class Rig>
void expect_sound_after_random_solid_cuts(int cuts, std::uint64_t seed) {
  Rig rig;
  Random random(seed);
  const CutNumbers next = [&random] { return random.uniform(-1, 1); };
  int done = 0, tried = 0;
  while (done < cuts && !::testing::Test::HasFailure()) {
    const auto solid = static_cast<std::size_t>(random.next() % rig.solids());
    rig.make_whole(solid);
    for (int n = 0; n < 50 && done < cuts; ++n) {
      SCOPED_TRACE("solid " + std::to_string(solid) + ", cut " + std::to_string(done));
      rig.cut(static_cast<std::size_t>(random.next() % rig.instruments()), next);
      ++tried;
      ASSERT_EQ(rig.why_unsound(), "");
      done += rig.took_something() ? 1 : 0;
      ASSERT_EQ(n % 5 == 4 ? rig.why_not_whole() : "", "");
      ASSERT_EQ(n == 24 ? rig.why_not_elastic() : "", "");
    }
  }
  EXPECT_GT(done, tried / 10) << "most meet what is left";
  std::printf("%d of %d cuts took something, %d pieces, volumes within %.2f mm3\n", done, tried,
              rig.pieces(), 1e9 * rig.most_off_m3());
}

}  // namespace osteon::testing
