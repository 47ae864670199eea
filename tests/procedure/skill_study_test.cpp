#include "osteon/procedure/skill_study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

const std::vector<StandardMetric> kWanted = {{"time_s", 0, 1, 1, true}, {"way_mm", 0, 1, 1, true}};

// People with one talent that both metrics show.
std::vector<Metrics> people(std::uint64_t seed, int count, double slower) {
  Random random(seed);
  std::vector<Metrics> all;
  for (int i = 0; i < count; ++i) {
    const double talent = random.normal(slower, 1);
    const double a = random.normal(0, 0.3), b = random.normal(0, 0.3);
    all.push_back({{"time_s", 60 + 10 * (talent + a)}, {"way_mm", 500 + 50 * (talent + b)}});
  }
  return all;
}

TEST(SkillStudy, RefusesTooFew) {
  EXPECT_FALSE(study_skill({}, {}, kWanted));
  EXPECT_FALSE(study_skill(people(1, 2, 0), people(2, 5, 3), kWanted));
  EXPECT_FALSE(study_skill(people(1, 5, 0), people(2, 5, 3), {{"nothing", 0, 1, 1, true}}));
}

TEST(SkillStudy, GroupsFarApartAreToldApart) {
  // Not so far that the scores' lower bound makes all novices alike: that sets no mark.
  const auto study = study_skill(people(3, 20, 0), people(32, 20, 5.5), kWanted);
  ASSERT_TRUE(study) << study.error().message();
  EXPECT_EQ(study->auc, 1);
  EXPECT_EQ(study->auc_se, 0);
  EXPECT_EQ(study->experts_failed, 0);
  EXPECT_EQ(study->novices_passed, 0);
  EXPECT_GT(study->reliability, 0.9);
  EXPECT_LT(study->mark, 100);
}

TEST(SkillStudy, WhereAllHaveTheLowestScoreNoMarkIsSet) {
  const auto study = study_skill(people(3, 20, 0), people(32, 20, 60), kWanted);
  ASSERT_TRUE(study) << study.error().message();
  EXPECT_EQ(study->auc, 1);
  EXPECT_EQ(study->without_mark, 40);
  EXPECT_TRUE(std::isnan(study->mark));
  const auto apart = study_skill(people(3, 20, 0), people(32, 20, 5.5), kWanted);
  ASSERT_TRUE(apart);
  EXPECT_EQ(apart->without_mark, 0);
}

// Such a metric has no norm: the scores are those of the others.
TEST(SkillStudy, AMetricThatIsTheSameForAllExpertsIsLeftOut) {
  auto experts = people(3, 20, 0), novices = people(32, 20, 5.5);
  for (auto* group : {&experts, &novices})
    for (Metrics& person : *group) person["right_percent"] = 100;
  experts.front()["right_percent"] = 75;
  std::vector<StandardMetric> asked = kWanted;
  asked.push_back({"right_percent", 0, 1, 1, false});
  const auto study = study_skill(experts, novices, asked),
             plain = study_skill(experts, novices, kWanted);
  ASSERT_TRUE(study) << study.error().message();
  ASSERT_TRUE(plain);
  EXPECT_EQ(study->left_out, std::vector<std::string>{"right_percent"});
  EXPECT_TRUE(plain->left_out.empty());
  EXPECT_EQ(study->expert_scores, plain->expert_scores);
  EXPECT_EQ(study->reliability, plain->reliability);
  EXPECT_FALSE(study_skill(experts, novices, {asked.back()}));
  const auto one = study_skill(experts, novices, {asked.front(), asked.back()});
  ASSERT_TRUE(one) << one.error().message();
  EXPECT_TRUE(std::isnan(one->reliability));
  EXPECT_EQ(one->expert_scores.size(), 20u);
  EXPECT_EQ(one->passed.size(), 40u);
  experts.back()["right_percent"] = 50;
  EXPECT_TRUE(study_skill(experts, novices, asked)->left_out.empty());
}

// Two normals d SD apart: AUC = Phi(d / sqrt 2); talents 2 apart with noise of 0.3 / sqrt 2.
TEST(SkillStudy, TheAreaIsThatOfTheNormals) {
  const auto study = study_skill(people(3, 300, 0), people(4, 300, 2), kWanted);
  ASSERT_TRUE(study);
  const double sd = std::sqrt(1 + 0.045);
  EXPECT_NEAR(study->auc, 0.5 * std::erfc(-2 / sd / 2), 0.02);
  EXPECT_NEAR(study->experts_failed / 300.0, 0.5 * std::erfc(1 / sd / std::sqrt(2.0)), 0.04);
}

TEST(SkillStudy, TheSameGroupTwiceTellsNothing) {
  const auto group = people(5, 30, 0);
  const auto study = study_skill(group, people(6, 30, 0), kWanted);
  ASSERT_TRUE(study);
  EXPECT_NEAR(study->auc, 0.5, 3 * study->auc_se);
}

// The mark must not know the person: one expert far off does not draw it down for itself.
TEST(SkillStudy, JudgesEachByAMarkSetWithoutIt) {
  auto experts = people(7, 10, 0);
  experts[3] = {{"time_s", 120}, {"way_mm", 800}};
  const auto study = study_skill(experts, people(8, 10, 6), kWanted);
  ASSERT_TRUE(study);
  EXPECT_FALSE(study->passed[3]);
}

}  // namespace
}  // namespace osteon
