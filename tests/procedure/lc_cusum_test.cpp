#include "osteon/procedure/lc_cusum.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

TEST(LcCusum, WeighsAsPublished) {
  const LcCusumOptions options{0.10, 0.15, 3.5, 3.5};
  EXPECT_NEAR(success_weight(options), std::log(0.90 / 0.75), 1e-15);  // 0.1823
  EXPECT_NEAR(failure_weight(options), std::log(0.10 / 0.25), 1e-15);  // -0.9163
  EXPECT_NEAR(success_weight(options), 0.1823, 5e-5);
  EXPECT_NEAR(failure_weight(options), -0.9163, 5e-5);
}

TEST(LcCusum, OfNothingSaysNothing) {
  const LcCusum curve = lc_cusum({});
  EXPECT_EQ(curve.competent_at, -1);
  EXPECT_TRUE(curve.s.empty());
}

TEST(LcCusum, SuccessesAddUpAndAFailureCostsFive) {
  const LcCusum curve = lc_cusum(std::vector<bool>(30, true));
  EXPECT_EQ(curve.competent_at, 19);  // 20 x 0.1823 = 3.646 is the first at or above 3.5
  EXPECT_NEAR(curve.s[19], 20 * std::log(1.2), 1e-12);
  std::vector<bool> one_failure(30, true);
  one_failure[10] = false;
  EXPECT_EQ(lc_cusum(one_failure).competent_at,
            25);  // 0.9163 / 0.1823 = 5.03 successes lost, and the failure itself
  EXPECT_EQ(lc_cusum(std::vector<bool>(50, false)).s.back(), 0);
}

TEST(LcCusum, WarnsOfARelapseAfterCompetenceOnly) {
  std::vector<bool> fails(30, false);
  EXPECT_EQ(lc_cusum(fails).relapse_at, -1);
  std::vector<bool> run(20, true);
  for (int i = 0; i < 3; ++i) run.push_back(false);
  EXPECT_EQ(lc_cusum(run).relapse_at, -1);
  run.push_back(false);  // 4 x 0.9163 = 3.665
  EXPECT_EQ(lc_cusum(run).relapse_at, 23);
}

// Of people who fail too often the published limit lets at most 5 % through within 50 attempts.
TEST(LcCusum, AtMostOneInTwentyIsCalledCompetentTooEarly) {
  Random random(11);
  int wrong = 0;
  constexpr int kPeople = 4000;
  for (int i = 0; i < kPeople; ++i) {
    std::vector<bool> passed;
    for (int k = 0; k < 50; ++k) passed.push_back(random.uniform() >= 0.25);
    if (lc_cusum(passed, {0.10, 0.15, 3.5, 3.5}).competent_at >= 0) ++wrong;
  }
  EXPECT_LE(wrong / double(kPeople), 0.06);
  EXPECT_GT(wrong, 0);
}

}  // namespace
}  // namespace osteon
