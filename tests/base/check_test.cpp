#include "osteon/base/check.h"

#include <gtest/gtest.h>

namespace osteon {
namespace {

TEST(Demand, PassesWhenTheConditionHolds) { demand(true, "never shown"); }

TEST(DemandDeathTest, StopsWithTheMessageInEveryBuild) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(demand(false, "index out of step"), "index out of step");
}

}  // namespace
}  // namespace osteon
