#include "osteon/device/inkwell.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(InkwellVisits, CountOnceThereAndBackWhicheverStateIsRest) {
  for (const bool rest : {false, true}) {
    InkwellVisits visits;
    int count = 0;
    for (const bool away : {false, false, true, true, false, false, true, false}) {
      const std::uint32_t other = 0x1f;  // buttons beside it
      const bool on = away != rest;
      count += visits.ended(other | (on ? 1u << kInkwellButton : 0u)) ? 1 : 0;
    }
    EXPECT_EQ(count, 2) << rest;
  }
}

TEST(InkwellVisits, OtherButtonsAreNone) {
  InkwellVisits visits;
  for (const std::uint32_t buttons : {0u, 1u, 0u, 0xfeffu, 0u}) EXPECT_FALSE(visits.ended(buttons));
}

}  // namespace
}  // namespace osteon
