#include "osteon/results/cohort.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "results/attempts.h"

namespace osteon {
namespace {

using ClassJson = nlohmann::json;

AttemptRow class_row(const std::string& learner, const std::string& verdict,
                     std::optional<double> score, const std::string& errors = "[]") {
  static int n = 0;
  AttemptRow row = test::row_of(7, n++);
  row.learner = learner;
  row.verdict = verdict;
  row.score = score;
  row.score_lo = score ? std::optional(*score - 5) : std::nullopt;
  row.score_hi = score ? std::optional(*score + 5) : std::nullopt;
  row.report_json = R"({"stages": [{"name": "one", "completed_s": 4.5}], "metrics": {"path_mm": )" +
                    std::to_string(score.value_or(0)) + R"(, "words": null}, "errors": )" + errors +
                    "}";
  return row;
}

const char* const kTwiceTooHard =
    R"([{"name": "too_hard", "severity": "major"}, {"name": "too_hard", "severity": "major"}])";
const char* const kBoth =
    R"([{"name": "slid", "severity": "minor"}, {"name": "too_hard", "severity": "major"}])";

std::vector<AttemptRow> a_class() {
  std::vector<AttemptRow> rows{class_row("ben", "not_passed", 60, kTwiceTooHard),
                               class_row("ann", "passed", 90),
                               class_row("ben", "not_passed", 70, kBoth),
                               class_row("cy", "not_passed", 66, kTwiceTooHard),
                               class_row("ann", "passed", 96),
                               class_row("cy", "undecided", std::nullopt)};
  rows.push_back(class_row("ann", "passed", 99));
  rows.back().scenario = "a_tour";
  return rows;
}

TEST(Cohort, WhoWasLedIsNotYetCompetent) {
  std::vector<AttemptRow> rows(60, class_row("ann", "passed", 90));
  for (AttemptRow& row : rows) row.verdict = "passed";
  const auto competent = [&] { return cohort_of(rows).at(0).learners.at(0).competent_at; };
  const int alone = competent();
  ASSERT_GT(alone, 0);
  for (AttemptRow& row : rows) row.report_json = R"({"metrics": {"guided_s": 3.5}})";
  EXPECT_TRUE(was_guided(rows[0]));
  EXPECT_EQ(competent(), -1);
  // The first five were led: competence comes five attempts later.
  for (std::size_t i = 5; i < rows.size(); ++i) rows[i].report_json = "{}";
  EXPECT_EQ(competent(), alone + 5);
  for (const char* not_led : {"", "[]", R"({"metrics": {"guided_s": 0}})", R"({"metrics": 3})",
                              R"({"metrics": {"guided_s": "x"}})"}) {
    rows[0].report_json = not_led;
    EXPECT_FALSE(was_guided(rows[0])) << not_led;
  }
}

TEST(Cohort, OfNobodyIsEmptyAndStillAPage) {
  EXPECT_TRUE(cohort_of({}).empty());
  EXPECT_NE(to_html({}).find("No attempts."), std::string::npos);
  EXPECT_EQ(ClassJson::parse(to_json(Cohort{})), ClassJson::array());
}

TEST(Cohort, CountsWhoDidWhatAndTheErrorsOfEach) {
  const Cohort cohort = cohort_of(a_class());
  ASSERT_EQ(cohort.size(), 2u);
  EXPECT_EQ(cohort[0].name, "a_tour");
  const CohortScenario& touch = cohort[1];
  EXPECT_EQ(touch.attempts, 6u);
  EXPECT_EQ(touch.passed, 2u);
  ASSERT_EQ(touch.learners.size(), 3u);
  EXPECT_EQ(touch.learners[0].learner, "ann");
  EXPECT_DOUBLE_EQ(*touch.learners[0].first_score, 90);
  EXPECT_DOUBLE_EQ(*touch.learners[0].last, 96);
  EXPECT_DOUBLE_EQ(*touch.learners[0].last_lo, 91);
  // An attempt without a score leaves the last one that has one.
  EXPECT_EQ(touch.learners[2].attempts, 2u);
  EXPECT_DOUBLE_EQ(*touch.learners[2].last, 66);
  ASSERT_EQ(touch.errors.size(), 2u);
  EXPECT_EQ(touch.errors[0].name, "too_hard");
  EXPECT_EQ(touch.errors[0].attempts, 3u);  // made twice in one attempt counts once
  EXPECT_EQ(touch.errors[0].learners, 2u);
  EXPECT_EQ(touch.errors[1].severity, "minor");
}

// First scores are 60, 66 and 90, second ones 70 and 96.
TEST(Cohort, TheCurveHasTheMedianAndQuartilesOfEachAttempt) {
  const auto curve = cohort_of(a_class())[1].curve;
  ASSERT_EQ(curve.size(), 2u);
  EXPECT_EQ(curve[0].learners, 3u);
  EXPECT_DOUBLE_EQ(curve[0].median, 66);
  EXPECT_DOUBLE_EQ(curve[0].lower, 63);
  EXPECT_DOUBLE_EQ(curve[0].upper, 78);
  EXPECT_EQ(curve[1].learners, 2u);
  EXPECT_DOUBLE_EQ(curve[1].median, 83);
}

TEST(Cohort, AReportThatCannotBeReadCountsWithoutErrors) {
  std::vector<AttemptRow> rows = a_class();
  for (AttemptRow& row : rows) row.report_json = "{";
  const Cohort cohort = cohort_of(rows);
  EXPECT_EQ(cohort[1].attempts, 6u);
  EXPECT_TRUE(cohort[1].errors.empty());
}

TEST(Cohort, ThePageShowsBarsAndHidesNamesUntilAskedFor) {
  Cohort cohort = cohort_of(a_class());
  const std::string plain = to_html(cohort), named = to_html(cohort, {{"ann", "A. <b> \"N\""}});
  EXPECT_EQ(plain.find("A. "), std::string::npos);
  EXPECT_NE(named.find("A. &lt;b&gt; &quot;N&quot; (ann)"), std::string::npos);
  EXPECT_EQ(named.find("<b>"), std::string::npos);
  std::size_t bars = 0;
  for (std::size_t at = 0; (at = plain.find("class=\"bar\"", at)) != plain.npos; ++at) ++bars;
  EXPECT_EQ(bars, 4u);
  EXPECT_EQ(plain.find("nan"), std::string::npos);
  EXPECT_EQ(plain.find("http"), std::string::npos);
}

TEST(Cohort, IsPrintedWithAsManyPagesAsItNeeds) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("osteon_cohort_" + std::to_string(::getpid()) + ".pdf");
  std::vector<AttemptRow> rows = a_class();
  for (int n = 0; n < 120; ++n) rows.push_back(class_row("x" + std::to_string(n), "passed", 80));
  ASSERT_TRUE(save_cohort_pdf(cohort_of(rows), {}, file));
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::filesystem::remove(file);
  EXPECT_TRUE(bytes.starts_with("%PDF"));
  std::size_t pages = 0;
  for (std::size_t at = 0; (at = bytes.find("/Type /Page\n", at)) != bytes.npos; ++at) ++pages;
  EXPECT_GE(pages, 4u);
  EXPECT_FALSE(save_cohort_pdf({}, {}, "/nowhere/class.pdf"));
}

TEST(Cohort, TwoAttemptsAreComparedByMetricStageAndError) {
  const AttemptRow a = class_row("ann", "not_passed", 60, kTwiceTooHard);
  AttemptRow b = class_row("ann", "passed", 90, kBoth);
  const auto text = compare_attempts(a, b);
  ASSERT_TRUE(text);
  const ClassJson json = ClassJson::parse(*text);
  EXPECT_TRUE(json["same_scenario"]);
  EXPECT_EQ(json["errors"]["both"], ClassJson::array({"too_hard"}));
  EXPECT_EQ(json["errors"]["only_b"], ClassJson::array({"slid"}));
  EXPECT_EQ(json["errors"]["only_a"], ClassJson::array());
  EXPECT_DOUBLE_EQ(json["metrics"][0]["change"], 30);
  EXPECT_TRUE(json["metrics"][1]["change"].is_null());
  EXPECT_DOUBLE_EQ(json["stages"][0]["a_s"], 4.5);
  b.scenario = "acl";
  EXPECT_FALSE(ClassJson::parse(*compare_attempts(a, b))["same_scenario"]);
  b.report_json = "no";
  EXPECT_FALSE(compare_attempts(a, b));
}

}  // namespace
}  // namespace osteon
