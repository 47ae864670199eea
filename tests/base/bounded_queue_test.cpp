#include "osteon/base/bounded_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace osteon {
namespace {

TEST(BoundedQueue, EmptyGivesNothing) {
  BoundedQueue<int> q(3);
  int v = 42;
  EXPECT_FALSE(q.pop(v));
  EXPECT_EQ(v, 42);
}

TEST(BoundedQueue, HoldsItsCapacityAndRefusesMore) {
  BoundedQueue<int> q(3);
  EXPECT_TRUE(q.push(1));
  EXPECT_TRUE(q.push(2));
  EXPECT_TRUE(q.push(3));
  EXPECT_FALSE(q.push(4));
  int v = 0;
  for (int want = 1; want <= 3; ++want) {
    ASSERT_TRUE(q.pop(v));
    EXPECT_EQ(v, want);
  }
  EXPECT_FALSE(q.pop(v));
}

TEST(BoundedQueue, ShowsWhatIsNextWhereItLies) {
  BoundedQueue<int> q(1);
  EXPECT_EQ(q.front(), nullptr);
  for (int round = 0; round < 5; ++round) {
    EXPECT_TRUE(q.push(round));
    ASSERT_NE(q.front(), nullptr);
    EXPECT_EQ(*q.front(), round);
    EXPECT_FALSE(q.push(99));  // it keeps its place until it is dropped
    q.drop();
    EXPECT_EQ(q.front(), nullptr);
  }
}

TEST(BoundedQueue, KeepsOrderAcrossThreads) {
  BoundedQueue<int> q(16);
  constexpr int kCount = 20000;
  std::thread producer([&] {
    for (int i = 0; i < kCount;) i += q.push(i) ? 1 : 0;
  });
  bool in_order = true;
  for (int want = 0; want < kCount;) {
    int v = -1;
    if (!q.pop(v)) continue;
    in_order = in_order && v == want;
    ++want;
  }
  producer.join();
  EXPECT_TRUE(in_order);
}

}  // namespace
}  // namespace osteon
