#include "cases/case_bone.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(PointFromMm, ThreeNumbersAreAPlaceInMetres) {
  const auto p = point_from_mm("10,-2.5,3e1", "--from");
  ASSERT_TRUE(p) << p.error().message();
  EXPECT_LT((*p - Vec3(0.010, -0.0025, 0.030)).norm(), 1e-15);
  EXPECT_TRUE(point_from_mm("10000,-10000,0", "--from"));
}

TEST(PointFromMm, WhatIsNoPlaceNamesTheOption) {
  for (const char* bad : {"", "1,2", "1,2,3,4", "1, 2,3", "nan,0,0", "inf,0,0", "1e20,1,1",
                          "0,0,-10000.1", "a,b,c", "1,2,3 "}) {
    const auto p = point_from_mm(bad, "--from");
    ASSERT_FALSE(p) << bad;
    EXPECT_NE(p.error().message().find("--from"), std::string::npos) << p.error().message();
  }
}

}  // namespace
}  // namespace osteon
