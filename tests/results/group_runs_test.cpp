#include "osteon/results/group_runs.h"

#include <gtest/gtest.h>

#include "results/attempts.h"

namespace osteon {
namespace {

AttemptRow timed_row(const std::string& learner, double elapsed_s, const std::string& more = "") {
  static int n = 0;
  AttemptRow row = test::row_of(9, n++);
  row.learner = learner;
  row.report_json =
      R"({"stages": [{"name": "one", "completed_s": 4.5}], "metrics": {"elapsed_s": )" +
      std::to_string(elapsed_s) + R"(, "words": null)" + more + "}}";
  return row;
}
AttemptRow broken_off(const std::string& learner) {
  AttemptRow row = timed_row(learner, 1);
  row.report_json =
      R"({"stages": [{"name": "one", "completed_s": null}], "metrics": {"elapsed_s": 1}})";
  return row;
}

TEST(GroupRuns, OfNobodyAndOfNothingIsEmpty) {
  EXPECT_TRUE(runs_of_group({}, "touch_bones", 1, {}, CountedAttempt::kFirst).learners.empty());
  const GroupRuns none = runs_of_group({}, "touch_bones", 1, {"ada"}, CountedAttempt::kFirst);
  EXPECT_TRUE(none.metrics.empty());
  EXPECT_EQ(none.without, std::vector<std::string>{"ada: no attempt"});
}

TEST(GroupRuns, EachPersonCountsOnceByTheirFirstOrLastAttempt) {
  const std::vector<AttemptRow> rows{timed_row("ada", 30), timed_row("ben", 50),
                                     timed_row("ada", 20), timed_row("ada", 10)};
  const std::vector<std::string> both{"ada", "ben", "ada"};
  const GroupRuns first = runs_of_group(rows, "touch_bones", 1, both, CountedAttempt::kFirst);
  EXPECT_EQ(first.learners, (std::vector<std::string>{"ada", "ben"}));
  EXPECT_EQ(first.metrics, (std::vector<Metrics>{{{"elapsed_s", 30}}, {{"elapsed_s", 50}}}));
  const GroupRuns last = runs_of_group(rows, "touch_bones", 1, both, CountedAttempt::kLast);
  EXPECT_EQ(last.metrics, (std::vector<Metrics>{{{"elapsed_s", 10}}, {{"elapsed_s", 50}}}));
}

TEST(GroupRuns, AttemptsBrokenOffLedOrOfAnotherExerciseDoNotCount) {
  std::vector<AttemptRow> rows{broken_off("ada"), timed_row("ada", 5, R"(, "guided_s": 2)"),
                               timed_row("ada", 7), timed_row("ada", 8)};
  rows[2].scenario = "a_tour";
  const auto of = [&](CountedAttempt counted) {
    return runs_of_group(rows, "touch_bones", 1, {"ada"}, counted);
  };
  EXPECT_EQ(of(CountedAttempt::kFirst).metrics, (std::vector<Metrics>{{{"elapsed_s", 8}}}));
  rows[3].scenario_version = 2;
  EXPECT_EQ(of(CountedAttempt::kLast).without,
            std::vector<std::string>{"ada: no whole attempt at version 1"});
  rows.pop_back();
  EXPECT_EQ(of(CountedAttempt::kLast).without, std::vector<std::string>{"ada: no whole attempt"});
  for (const char* unreadable : {"", "[]", "{}", R"({"stages": [], "metrics": {}})",
                                 R"({"stages": [3], "metrics": {}})", R"({"stages": 1})"}) {
    rows[0].report_json = unreadable;
    EXPECT_TRUE(of(CountedAttempt::kFirst).learners.empty()) << unreadable;
  }
}

}  // namespace
}  // namespace osteon
