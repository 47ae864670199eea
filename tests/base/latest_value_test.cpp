#include "osteon/base/latest_value.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace osteon {
namespace {

TEST(LatestValue, GivesTheInitialValueBeforeAnyPublish) {
  LatestValue<int> box(7);
  bool fresh = true;
  EXPECT_EQ(box.read(&fresh), 7);
  EXPECT_FALSE(fresh);
}

TEST(LatestValue, GivesTheNewestAndForgetsTheRest) {
  LatestValue<int> box(0);
  for (int i = 1; i <= 5; ++i) box.publish(i);
  bool fresh = false;
  EXPECT_EQ(box.read(&fresh), 5);
  EXPECT_TRUE(fresh);
  EXPECT_EQ(box.read(&fresh), 5);
  EXPECT_FALSE(fresh);
}

// Two threads: values arrive whole and never go back. Run under the thread sanitizer too.
TEST(LatestValue, WholeAndInOrderAcrossThreads) {
  using Block = std::array<std::uint64_t, 32>;
  LatestValue<Block> box;
  constexpr std::uint64_t kCount = 20000;
  std::thread writer([&] {
    for (std::uint64_t i = 1; i <= kCount; ++i) {
      Block b;
      b.fill(i);
      box.publish(b);
    }
  });
  std::uint64_t last = 0;
  bool whole = true;
  bool in_order = true;
  while (last < kCount) {
    const Block& b = box.read();
    for (const std::uint64_t v : b) whole = whole && v == b[0];
    in_order = in_order && b[0] >= last;
    last = b[0];
  }
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(in_order);
}

}  // namespace
}  // namespace osteon
