#include "commands/sessions/stability_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace osteon {
namespace {

TEST(StabilityMap, ShowsWhereItSwingsAndThatTheWholeStageStopsIt) {
  const HandParams hand{0.15, 500, 12};
  const StabilityMap bare = map_stability(hand, LoopGuard::kNone, 5, 5);
  const StabilityMap damped = map_stability(hand, LoopGuard::kObserverAndDamping, 5, 5);
  const StabilityMap whole = map_stability(hand, LoopGuard::kAll, 5, 5);
  EXPECT_GT(bare.swinging(), 2);
  EXPECT_LT(bare.swinging(), 25);
  EXPECT_LE(damped.swinging(), bare.swinging());
  EXPECT_EQ(whole.swinging(), 0);
  EXPECT_FALSE(bare.outcomes[0].swing_m > 1e-4);  // soft and prompt
  EXPECT_GT(bare.outcomes[24].swing_m, 1e-3);     // stiff and late
}

TEST(StabilityMap, ThePictureHasACellForEachOutcome) {
  StabilityMap map;
  EXPECT_NE(to_svg({}, 1).find("</svg>"), std::string::npos);
  map = map_stability({0.15, 500, 12}, LoopGuard::kNone, 3, 2);
  map.title = "a title";
  const std::string svg = to_svg({map, map}, 2);
  std::size_t cells = 0;
  for (std::size_t at = svg.find("fill=\"rgb"); at != std::string::npos;
       at = svg.find("fill=\"rgb", at + 1))
    ++cells;
  EXPECT_EQ(cells, 12u);
  EXPECT_NE(svg.find("a title"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace osteon
