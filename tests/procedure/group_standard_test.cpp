#include "osteon/procedure/group_standard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

Standard two_asked() {
  Standard draft;
  draft.scenario = "touch_bones";
  draft.version = 4;
  draft.source = "a lab's own";
  draft.metrics = {{"time_s", 0, 1, 2, true}, {"right", 0, 1, 1, false}};
  return draft;
}

// People whose talent both metrics show; `slower` in experts' SD.
std::vector<Metrics> group_of(std::uint64_t seed, int count, double slower) {
  Random random(seed);
  std::vector<Metrics> all;
  for (int i = 0; i < count; ++i) {
    const double talent = random.normal(slower, 1);
    const double a = random.normal(0, 0.3), b = random.normal(0, 0.3);
    all.push_back({{"time_s", 60 + 10 * (talent + a)}, {"right", 50 - 5 * (talent + b)}});
  }
  return all;
}

TEST(GroupStandard, RefusesTooFewAndGroupsThatDoNotPart) {
  EXPECT_FALSE(standard_of_groups(two_asked(), {}, {}));
  EXPECT_FALSE(standard_of_groups(two_asked(), group_of(1, 2, 0), group_of(2, 9, 3)));
  EXPECT_FALSE(standard_of_groups(two_asked(), group_of(1, 9, 3), group_of(2, 9, 0)));
  Standard other = two_asked();
  other.metrics[0].name = "nothing";
  EXPECT_FALSE(standard_of_groups(other, group_of(1, 9, 0), group_of(2, 9, 3)));
}

// Experts and novices of one spread d apart, both metrics equally good: the mark lies halfway, and
// an expert scores 100.
TEST(GroupStandard, HasTheExpertsNormsAndAMarkBetweenTheGroups) {
  const auto experts = group_of(11, 400, 0), novices = group_of(12, 400, 3);
  const auto set = standard_of_groups(two_asked(), experts, novices);
  ASSERT_TRUE(set) << set.error().message();
  const Standard& s = set->standard;
  EXPECT_EQ(s.scenario, "touch_bones");
  EXPECT_EQ(s.version, 4);
  EXPECT_EQ(s.experts, 400);
  ASSERT_EQ(s.metrics.size(), 2u);
  EXPECT_NEAR(s.metrics[0].mean, 60, 1.5);
  EXPECT_NEAR(s.metrics[0].sd, 10 * std::sqrt(1.09), 0.6);
  EXPECT_EQ(s.metrics[0].weight, 2);
  EXPECT_FALSE(s.metrics[1].lower_is_better);
  // Novices are 3 / sqrt(1.09) experts' SD away in each metric.
  EXPECT_NEAR(s.pass_score, 100 - 0.5 * 30 / std::sqrt(1.09), 1.5);
  EXPECT_NEAR(s.score_sd, 10 * std::sqrt(0.25 * 9 / 1.09 + 1), 1);
  // Two items with unit variance of the talent over 0.09 of noise, and the groups' distance.
  const double talent = 1 + 0.25 * 9, noise = 0.09;
  EXPECT_NEAR(s.reliability, talent / (talent + noise / 2), 0.02);
  EXPECT_GT(set->study.auc, 0.97);
  EXPECT_NEAR(set->mark.experts_failed, set->mark.novices_passed, 0.03);
}

TEST(GroupStandard, CanBeWrittenAndReadWhateverItsSourceHolds) {
  Standard draft = two_asked();
  draft.source = "our \"own\" C:\\lab\nof May";
  const auto set = standard_of_groups(draft, group_of(1, 9, 0), group_of(2, 9, 3));
  ASSERT_TRUE(set) << set.error().message();
  const auto read = parse_standard(to_toml(set->standard), "s.toml");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->source, "our \"own\" C:\\lab of May");
  EXPECT_EQ(read->metrics.size(), 2u);
}

TEST(GroupStandard, OfOneMetricHasTheWidestInterval) {
  Standard draft = two_asked();
  draft.metrics.pop_back();
  const auto set = standard_of_groups(draft, group_of(1, 9, 0), group_of(2, 9, 3));
  ASSERT_TRUE(set) << set.error().message();
  EXPECT_EQ(set->standard.reliability, 0);
}

TEST(GroupStandard, LeavesOutWhatIsTheSameForAllExperts) {
  auto experts = group_of(1, 9, 0);
  for (Metrics& one : experts) one["right"] = 40;
  const auto set = standard_of_groups(two_asked(), experts, group_of(2, 9, 3));
  ASSERT_TRUE(set) << set.error().message();
  EXPECT_EQ(set->study.left_out, std::vector<std::string>{"right"});
  EXPECT_EQ(set->standard.metrics.size(), 1u);
}

}  // namespace
}  // namespace osteon
