#include "exercises/number_teller.h"

#include <gtest/gtest.h>

#include <vector>

namespace osteon {
namespace {

NumberTeller knee_teller() { return {CommandKind::kKneeOrder, CommandKind::kKneeNumber}; }

TEST(NumberTeller, SaysTheOrderAndThenEachNumber) {
  NumberTeller teller = knee_teller();
  EXPECT_FALSE(teller.telling() || teller.under_way(0) || teller.take());
  teller.tell(std::vector<double>{3, 4}, 10);
  EXPECT_EQ(teller.take()->kind, CommandKind::kKneeOrder);
  for (const double number : {3.0, 4.0}) {
    EXPECT_TRUE(teller.telling());
    const auto said = teller.take();
    ASSERT_TRUE(said);
    EXPECT_EQ(said->kind, CommandKind::kKneeNumber);
    EXPECT_EQ(said->value, number);
  }
  EXPECT_FALSE(teller.telling() || teller.take());
}

// It is under way for a second from the last look before its last command on, however long the
// others took.
TEST(NumberTeller, TheLastCommandCounts) {
  NumberTeller teller = knee_teller();
  teller.tell(std::vector<double>(30, 1.0), 0);
  double now_s = 0;
  while (teller.telling()) {
    now_s += 0.1;
    teller.look(now_s);
    (void)teller.take();
  }
  EXPECT_GT(now_s, 3);
  teller.look(now_s + 0.9);
  EXPECT_TRUE(teller.under_way(now_s + 0.9));
  EXPECT_FALSE(teller.under_way(now_s + 1.1));
}

}  // namespace
}  // namespace osteon
