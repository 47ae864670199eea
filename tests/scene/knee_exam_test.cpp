#include "osteon/scene/knee_exam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "placing_case.h"

namespace osteon {
namespace {

// Forwards by 1 mm for each quarter of the load and each 10 degrees; the other test twice that.
KneeGiveTable even_table() {
  KneeGiveTable table;
  table.tibia = table.fibula = 1;
  table.front_n = 134;
  table.valgus_nm = 10;
  table.internal_nm = 4;
  for (std::size_t t = 0; t < kKneeTests; ++t)
    for (std::size_t b = 0; b < KneeGiveTable::kBends; ++b)
      for (std::size_t k = 0; k < KneeGiveTable::kShares; ++k) {
        const double mm = static_cast<double>((t + 1) * (b + 1) * (k + 1));
        table.gives[t][b][k] = {Vec3(0, 0, 0.001 * mm), Vec3(0, 0.01 * mm, 0), 0.001 * mm,
                                0.0005 * mm};
      }
  return table;
}

TEST(KneeExamTable, NumbersThatAreNoTableAreRefused) {
  const auto knee = testing::placing_knee();
  const std::vector<double> good = give_numbers(even_table());
  ASSERT_EQ(good.size(), kKneeGiveNumbers);
  ASSERT_TRUE(give_of_numbers(*knee, good));
  EXPECT_FALSE(give_of_numbers(*knee, {}));
  EXPECT_FALSE(give_of_numbers(*knee, std::span(good).first(kKneeGiveNumbers - 1)));
  const double bads[] = {std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(), 1e9, -1e9};
  for (const std::size_t at : {0u, 1u, 2u, 3u, 6u, 9u, 300u})
    for (const double bad : bads) {
      auto numbers = good;
      numbers[at] = bad;
      EXPECT_FALSE(give_of_numbers(*knee, numbers)) << at << " " << bad;
    }
  auto no_bone = good;
  no_bone[1] = 7;
  EXPECT_FALSE(give_of_numbers(*knee, no_bone));
  auto no_load = good;
  no_load[6] = 0;
  EXPECT_FALSE(give_of_numbers(*knee, no_load));
}

TEST(KneeExamTable, NumbersSayAllOfATable) {
  const auto knee = testing::placing_knee();
  const std::vector<double> numbers = give_numbers(even_table());
  const auto again = give_of_numbers(*knee, numbers);
  ASSERT_TRUE(again);
  EXPECT_EQ(give_numbers(*again), numbers);
  auto other = numbers;
  other.back() += 1e-6;
  EXPECT_NE(give_digest(other), give_digest(numbers));
  EXPECT_NE(give_digest(std::span(numbers).first(5)), give_digest(numbers));
}

TEST(KneeExamTable, GoesThroughItsPlacesAndStraightBetweenThem) {
  const KneeGiveTable table = even_table();
  const auto front_mm = [&](KneeTest test, double deg, double share) {
    return 1e3 * give_at(table, test, deg, share)->front_m;
  };
  EXPECT_NEAR(front_mm(KneeTest::kLachman, 30, 1), 16, 1e-9);
  EXPECT_NEAR(front_mm(KneeTest::kLachman, 30, 0.5), 8, 1e-9);
  EXPECT_NEAR(front_mm(KneeTest::kLachman, 35, 1), 18, 1e-9);
  EXPECT_NEAR(front_mm(KneeTest::kLachman, 30, 0.125), 2, 1e-9);
  EXPECT_NEAR(front_mm(KneeTest::kLachman, 30, 0), 0, 1e-12);
  EXPECT_NEAR(front_mm(KneeTest::kPivot, 40, 1), 40, 1e-9);
  EXPECT_NEAR(front_mm(KneeTest::kLachman, -5, 1), 4, 1e-9);
  EXPECT_NEAR(front_mm(KneeTest::kLachman, 30, 7), 16, 1e-9);
  EXPECT_NEAR(1e3 * give_at(table, KneeTest::kLachman, 30, 1)->other_front_m, 8, 1e-9);
  EXPECT_FALSE(give_at(table, KneeTest::kLachman, 40.1, 1));
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(give_at(table, KneeTest::kLachman, none, 1));
  EXPECT_FALSE(give_at(table, KneeTest::kLachman, 30, none));
}

// The middle goes as said, and what is beside it turns about it.
TEST(KneeExamTable, MovesTheLowerLegAboutItsMiddle) {
  const Vec3 middle(0.01, 0.02, -0.03);
  const Pose bent{middle + Vec3(0, 0, -0.1), Quat::Identity()};
  const Pose still = given_pose({}, middle, bent);
  EXPECT_EQ(still.p, bent.p);
  EXPECT_LT(still.q.angularDistance(bent.q), 1e-15);
  KneeGive give;
  give.way_B = Vec3(0.012, 0, 0);
  give.turn_B = Vec3(0, 0.1, 0);
  const Pose moved = given_pose(give, middle, bent);
  EXPECT_LT((moved * (bent.inverse() * middle) - (middle + give.way_B)).norm(), 1e-12);
  EXPECT_NEAR(moved.q.angularDistance(bent.q), 0.1, 1e-12);
  EXPECT_NEAR(moved.p.x(), middle.x() + 0.012 - 0.1 * std::sin(0.1), 1e-12);
}

}  // namespace
}  // namespace osteon
