#include "osteon/base/union_find.h"

#include <gtest/gtest.h>

#include <random>

namespace osteon {
namespace {

TEST(UnionFind, NothingHasNoNames) { EXPECT_TRUE(UnionFind{}.names().empty()); }

TEST(UnionFind, EachIsAloneAtFirst) {
  UnionFind sets(3);
  EXPECT_EQ(sets.names(), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(sets.add(), 3U);
  EXPECT_EQ(sets.find(3), 3U);
}

TEST(UnionFind, JoiningOneWithItselfOrTwiceChangesNothing) {
  UnionFind sets(2);
  sets.join(1, 1);
  EXPECT_EQ(sets.find(1), 1U);
  sets.join(1, 0);
  sets.join(0, 1);
  EXPECT_EQ(sets.names(), (std::vector<std::uint32_t>{0, 0}));
}

// The oracle names sets anew after every join, member by member.
TEST(UnionFind, NamesAreTheLowestMembersWhateverTheOrderOfTheJoins) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    constexpr std::uint32_t kCount = 40;
    UnionFind sets(kCount);
    std::vector<std::uint32_t> named(kCount);
    std::iota(named.begin(), named.end(), 0U);
    for (int k = 0; k < 30; ++k) {
      const std::uint32_t a = random() % kCount, b = random() % kCount;
      sets.join(a, b);
      const std::uint32_t kept = std::min(named[a], named[b]);
      const std::uint32_t lost = std::max(named[a], named[b]);
      std::replace(named.begin(), named.end(), lost, kept);
      ASSERT_EQ(sets.find(a), kept);
    }
    EXPECT_EQ(sets.names(), named);
  }
}

}  // namespace
}  // namespace osteon
