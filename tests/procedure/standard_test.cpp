#include "osteon/procedure/standard.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/base/random.h"

namespace osteon {
namespace {

Standard two_metrics() {
  Standard s;
  s.scenario = "touch_bones";
  s.source = "a test";
  s.experts = 20;
  s.reliability = 0.75;
  s.score_sd = 10;
  s.pass_score = 80;
  s.metrics = {{"elapsed_s", 60, 10, 1, true}, {"sparc", -5, 1, 3, false}};
  return s;
}

TEST(Standard, ReadsWhatItWrites) {
  const auto read = parse_standard(to_toml(two_metrics()), "s.toml");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(to_toml(*read), to_toml(two_metrics()));
  EXPECT_EQ(read->metrics[1].lower_is_better, false);
}

TEST(Standard, NamesTheLineOfWhatIsWrong) {
  std::string text = to_toml(two_metrics());
  text.replace(text.find("sd = 10"), 7, "sd = -1");
  const auto read = parse_standard(text, "s.toml");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where, "s.toml:7");
  EXPECT_FALSE(parse_standard("format = 1", "s.toml"));
  EXPECT_FALSE(parse_standard("format = ", "s.toml"));
}

TEST(Standard, AnExpertOfTheMeanScoresAHundredWithItsInterval) {
  const auto score = score_of(two_metrics(), {{"elapsed_s", 60}, {"sparc", -5}});
  ASSERT_TRUE(score);
  EXPECT_DOUBLE_EQ(score->value, 100);
  EXPECT_DOUBLE_EQ(score->hi - score->value, 1.96 * 5);  // 10 sqrt(1 - 0.75)
  EXPECT_DOUBLE_EQ(score->value - score->lo, 1.96 * 5);
}

TEST(Standard, MetricsCountByTheirWeightAndDirection) {
  const auto slower = score_of(two_metrics(), {{"elapsed_s", 80}, {"sparc", -5}});
  EXPECT_DOUBLE_EQ(slower->value, 100 - 10 * 2.0 / 4);
  const auto rougher = score_of(two_metrics(), {{"elapsed_s", 60}, {"sparc", -6}}, 3);
  EXPECT_DOUBLE_EQ(rougher->value, 100 - 10 * 3.0 / 4 - 3);
  EXPECT_FALSE(score_of(two_metrics(), {{"elapsed_s", 60}}));
  EXPECT_FALSE(score_of(two_metrics(), {{"elapsed_s", NAN}, {"sparc", -5}}));
}

TEST(Standard, TheIntervalDecidesOrDoesNot) {
  const Standard s = two_metrics();
  EXPECT_EQ(verdict_of(s, {95, 85, 105}), Verdict::kPassed);
  EXPECT_EQ(verdict_of(s, {60, 50, 70}), Verdict::kNotPassed);
  EXPECT_EQ(verdict_of(s, {82, 72, 92}), Verdict::kUndecided);
  EXPECT_EQ(verdict_of(s, {90, 80, 100}), Verdict::kPassed);
}

// True scores of a group, and what is measured of them with the error that the reliability says.
TEST(Standard, TheIntervalCoversTheTrueScoreWith95Percent) {
  Random random(3);
  const double r = 0.8, sd = 12, sem = sd * std::sqrt(1 - r);
  Standard s = two_metrics();
  s.reliability = r;
  s.score_sd = sd;
  s.metrics = {{"x", 0, 1, 1, false}};
  int covered = 0;
  constexpr int kPeople = 20000;
  for (int i = 0; i < kPeople; ++i) {
    const double truth = random.normal(80, sd * std::sqrt(r));
    const double error = random.normal(0, sem);
    const auto score = score_of(s, {{"x", (truth + error - 100) / 10}});
    if (std::abs((truth + error - 100) / 10) >= 6) continue;
    if (score->lo <= truth && truth <= score->hi) ++covered;
  }
  EXPECT_NEAR(covered / double(kPeople), 0.95, 0.005);  // 0.0015 is one standard error
}

TEST(Norm, IsMeanAndSpreadOfTheExperts) {
  const auto norm = norm_of({{{"t", 8}}, {{"t", 10}}, {{"t", 12}}}, {{"t", 0, 1, 1, true}});
  ASSERT_TRUE(norm);
  EXPECT_DOUBLE_EQ((*norm)[0].mean, 10);
  EXPECT_DOUBLE_EQ((*norm)[0].sd, 2);
  EXPECT_FALSE(norm_of({{{"t", 8}}}, {{"t", 0, 1, 1, true}}));
  EXPECT_FALSE(norm_of({{{"t", 8}}, {{"t", 8}}}, {{"t", 0, 1, 1, true}}));
  EXPECT_FALSE(norm_of({{{"t", 8}}, {{"u", 8}}}, {{"t", 0, 1, 1, true}}));
}

TEST(ContrastingGroups, OfEqualSpreadMeetInTheMiddle) {
  const auto mark = contrasting_groups({89, 90, 91, 92, 93}, {49, 50, 51, 52, 53});
  ASSERT_TRUE(mark);
  EXPECT_NEAR(mark->mark, 71, 1e-9);
  EXPECT_NEAR(mark->experts_failed, mark->novices_passed, 1e-12);
}

TEST(ContrastingGroups, OfUnequalSpreadMeetWhereTheDensitiesAreEqual) {
  const std::vector<double> experts{80, 100}, novices{30, 40, 50};  // N(90, 14.14), N(40, 10)
  const auto mark = contrasting_groups(experts, novices);
  ASSERT_TRUE(mark);
  const double e = (mark->mark - 90) / std::sqrt(200), n = (mark->mark - 40) / 10;
  EXPECT_NEAR(std::exp(-e * e / 2) / std::sqrt(200), std::exp(-n * n / 2) / 10, 1e-12);
  EXPECT_NEAR(mark->novices_passed, 0.5 * std::erfc(n / std::sqrt(2)), 1e-12);
  EXPECT_FALSE(contrasting_groups(novices, experts));
  EXPECT_FALSE(contrasting_groups({1, 1}, {0, 0.5}));
  EXPECT_FALSE(contrasting_groups({1}, {0, 0.5}));
}

TEST(CronbachAlpha, OfAgreeingAndIndependentItems) {
  EXPECT_DOUBLE_EQ(*cronbach_alpha({{1, 1, 1}, {2, 2, 2}, {5, 5, 5}}), 1);
  EXPECT_NEAR(*cronbach_alpha({{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}), 0, 1e-12);
  // Worked by hand: item variances 1 and 3, total's 7, alpha = 2 (1 - 4 / 7).
  EXPECT_NEAR(*cronbach_alpha({{1, 0}, {2, 3}, {3, 3}}), 2 * (1 - 4.0 / 7), 1e-12);
  EXPECT_FALSE(cronbach_alpha({{1, 2}}));
  EXPECT_FALSE(cronbach_alpha({{1, 2}, {1}}));
}

TEST(AreaUnderCurve, CountsPairsInOrder) {
  EXPECT_DOUBLE_EQ(*area_under_curve({3, 4}, {1, 2}), 1);
  EXPECT_DOUBLE_EQ(*area_under_curve({1, 2}, {1, 2}), 0.5);
  EXPECT_DOUBLE_EQ(*area_under_curve({1, 4}, {2, 3}), 0.5);
  EXPECT_FALSE(area_under_curve({}, {1}));
}

}  // namespace
}  // namespace osteon
