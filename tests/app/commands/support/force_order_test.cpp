#include "commands/support/force_order.h"

#include <gtest/gtest.h>

#include <vector>

namespace osteon {
namespace {

const std::vector<std::string> kTwo = {"left", "right"};

TEST(ForceOrder, IsOfOneHandOrOfAll) {
  const auto all = parse_force_order("on", kTwo);
  ASSERT_TRUE(all);
  EXPECT_TRUE(all->on);
  EXPECT_FALSE(all->hand);
  const auto right = parse_force_order("  off  right \r", kTwo);
  ASSERT_TRUE(right);
  EXPECT_FALSE(right->on);
  EXPECT_EQ(right->hand, 1u);
  EXPECT_EQ(parse_force_order("on 1", kTwo)->hand, 0u);
  EXPECT_EQ(parse_force_order("on 1", std::vector<std::string>{""})->hand, 0u);
}

TEST(ForceOrder, SaysWhatThereIsOtherwise) {
  for (const char* line : {"", "left", "on third", "on 3", "on 0", "on left now", "ON"}) {
    const auto order = parse_force_order(line, kTwo);
    ASSERT_FALSE(order) << line;
    EXPECT_NE(order.error().message().find("left, right"), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace osteon
