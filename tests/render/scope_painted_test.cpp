#include "scope_painted.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(ScopePainted, OfNothingIsStill) { EXPECT_TRUE(ScopePainted().still({})); }

TEST(ScopePainted, WhatNobodySeesMoveIsStillAndWhatIsSeenIsNot) {
  ScopePainted a;
  a.parts.resize(2);
  a.tools.resize(1);
  for (const double by_m : {1e-6, 1e-5}) {
    const bool still = by_m < 2e-6;
    ScopePainted eye = a, part = a, tool = a, turned = a;
    eye.X_WC.p.x() += by_m;
    part.parts[1].p.y() += by_m;
    tool.tools[0].p.z() += by_m;
    turned.parts[0].q = Quat(Eigen::AngleAxisd(10 * by_m, Vec3::UnitX()));
    for (const ScopePainted& b : {eye, part, tool, turned}) {
      EXPECT_EQ(a.still(b), still) << by_m;
      EXPECT_EQ(b.still(a), still) << by_m;
    }
  }
}

TEST(ScopePainted, AnythingElseThatDiffersIsSeen) {
  const ScopePainted a;
  std::vector<ScopePainted> others(9, a);
  others[0].side_px = 1;
  others[1].barrel = 1.1;
  others[2].parts.resize(1);
  others[3].instruments = {2};
  others[4].ghosts = {0.5f};
  others[5].version = 1;
  others[6].wall = 1;
  others[7].white.x() = 0.9;
  others[8].bits.resize(1);
  for (std::size_t k = 0; k < others.size(); ++k) EXPECT_FALSE(a.still(others[k])) << k;
}

}  // namespace
}  // namespace osteon
