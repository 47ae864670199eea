#include "osteon/base/warm_queue.h"

#include <gtest/gtest.h>

#include <deque>
#include <thread>

#include "osteon/base/random.h"

namespace osteon {
namespace {

TEST(WarmQueue, EmptyShowsNothing) {
  const WarmQueue<int> q(2, 3);
  EXPECT_EQ(q.front(), nullptr);
}

TEST(WarmQueue, HoldsAllItsPlacesAndRefusesMore) {
  WarmQueue<int> q(2, 3);
  for (int i = 1; i <= 5; ++i) EXPECT_TRUE(q.push(i));
  EXPECT_FALSE(q.push(6));
  for (int want = 1; want <= 5; ++want) {
    ASSERT_NE(q.front(), nullptr);
    EXPECT_EQ(*q.front(), want);
    q.drop();
  }
  EXPECT_EQ(q.front(), nullptr);
}

// Any order of pushes and drops gives what a plain queue gives. Few places are free again long
// before the rest is empty: what comes then must not overtake it.
TEST(WarmQueue, KeepsItsOrderWhateverWasFull) {
  WarmQueue<int> q(3, 6);
  std::deque<int> plain;
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    if (random.uniform() < 0.5) {
      const bool had_room = q.push(i);
      if (had_room) plain.push_back(i);
      EXPECT_TRUE(had_room || plain.size() >= 6);
    } else if (const int* next = q.front()) {
      ASSERT_FALSE(plain.empty());
      ASSERT_EQ(*next, plain.front());
      q.drop();
      plain.pop_front();
    } else {
      ASSERT_TRUE(plain.empty());
    }
  }
}

TEST(WarmQueue, KeepsItsOrderAcrossThreads) {
  WarmQueue<int> q(2, 16);
  constexpr int kCount = 20000;
  std::thread producer([&] {
    for (int i = 0; i < kCount;) i += q.push(i) ? 1 : 0;
  });
  bool in_order = true;
  for (int want = 0; want < kCount;) {
    const int* const next = q.front();
    if (!next) continue;
    in_order = in_order && *next == want;
    q.drop();
    ++want;
  }
  producer.join();
  EXPECT_TRUE(in_order);
}

}  // namespace
}  // namespace osteon
