#include "expectation.h"

#include <gtest/gtest.h>

#include <limits>

#include "report_fixtures.h"

namespace osteon {
namespace {

using testing::sample_report;

std::vector<std::string> deviations(const std::string& json, const Report& r = sample_report()) {
  const auto lines = check_expectation(r, json);
  EXPECT_TRUE(lines) << json << ": " << lines.error().message();
  return lines.value_or(std::vector<std::string>{"failed"});
}

void expect_malformed(const std::string& json, const std::string& saying) {
  const auto lines = check_expectation(sample_report(), json);
  ASSERT_FALSE(lines) << json;
  EXPECT_NE(lines.error().message().find(saying), std::string::npos) << lines.error().message();
  EXPECT_FALSE(lines.error().todo.empty());
}

TEST(Expectation, RefusesWhatIsNoObject) {
  expect_malformed("", "not JSON");
  expect_malformed("{", "not JSON");
  expect_malformed("[]", "not a JSON object");
  expect_malformed("3", "not a JSON object");
  expect_malformed("{}", "no expectations");
  expect_malformed(R"({"ticks": {"min": 1e999}})", "not JSON");
  expect_malformed(std::string(100000, '['), "not JSON");
}

TEST(Expectation, RefusesUnknownAndRepeatedKeys) {
  expect_malformed(R"({"path_lenght_mm": {"min": 1}})", "path_lenght_mm");
  expect_malformed(R"({"bones": {"radius": {"peak": {"min": 1}}}})", "bones.radius.peak");
  expect_malformed(R"({"tick_us": {"p90": {"max": 1}}})", "tick_us.p90");
  expect_malformed(R"({"ticks": {"min": 1}, "ticks": {"min": 2}})", "twice");
  expect_malformed(R"({"bones": {"radius": {"deepest_mm": {"min": 1, "min": 2}}}})", "twice");
}

TEST(Expectation, TheSameKeyInTwoObjectsIsNoRepetition) {
  EXPECT_TRUE(deviations(R"({"bones": {"radius": {"peak_force_n": {"min": 1}},
                                       "lunate": {"peak_force_n": {"min": 1}}}})")
                  .empty());
}

TEST(Expectation, RefusesMalformedRanges) {
  for (const char* range :
       {"3", "{}", "[]", "null", R"({"min": "1"})", R"({"min": 1, "abs": 2})", R"({"value": 1})",
        R"({"abs": 1})", R"({"value": 1, "tolerance": 1})", R"({"value": 1, "abs": 1, "rel": 1})"})
    expect_malformed(std::string(R"({"path_length_mm": )") + range + "}", "path_length_mm");
  expect_malformed(R"({"ticks": {"min": 2, "max": 1}})", "empty");
  expect_malformed(R"({"ticks": {"value": 2, "abs": -1}})", "negative");
}

TEST(Expectation, RefusesMalformedLists) {
  expect_malformed(R"({"touched": "radius"})", "touched");
  expect_malformed(R"({"touched": []})", "touched");
  expect_malformed(R"({"touched": [3]})", "touched");
  expect_malformed(R"({"touched": ["radius", "radius"]})", "twice");
  expect_malformed(R"({"untouched": "all"})", "untouched");
  expect_malformed(R"({"bones": {}})", "bones");
  expect_malformed(R"({"bones": {"radius": {}}})", "bones.radius");
  expect_malformed(R"({"case": 3})", "case");
  expect_malformed(R"({"state_hash": "12"})", "state_hash");
}

TEST(Expectation, RefusesBonesThatAreNotThere) {
  expect_malformed(R"({"touched": ["femur"]})", "femur");
  expect_malformed(R"({"untouched": ["femur"]})", "femur");
  expect_malformed(R"({"order": ["radius", "femur"]})", "femur");
  expect_malformed(R"({"bones": {"femur": {"deepest_mm": {"max": 1}}}})", "femur");
}

TEST(Expectation, RefusesAContradiction) {
  expect_malformed(R"({"touched": ["radius"], "untouched": ["radius"]})", "radius");
  expect_malformed(R"({"order": ["radius"], "untouched": ["radius"]})", "radius");
}

TEST(Expectation, HoldsForAMatchingReport) {
  EXPECT_TRUE(deviations(R"({
    "case": "wrist", "touched": ["radius", "lunate"], "untouched": "all_others",
    "order": ["radius", "lunate"],
    "bones": {"radius": {"first_contact_s": {"value": 1.5, "abs": 0.1},
                         "contact_time_s": {"value": 3, "rel": 0.1},
                         "peak_force_n": {"min": 2, "max": 3},
                         "mean_force_n": {"max": 1.25}, "deepest_mm": {"min": 0.75}}},
    "path_length_mm": {"value": 800, "rel": 0.02}, "duration_s": {"value": 60, "abs": 0.5},
    "smoothness_sparc": {"min": -8}, "ticks": {"value": 60500, "abs": 0},
    "missed_ticks": {"max": 3}, "realtime_factor": {"min": 20},
    "tick_us": {"p50": {"max": 10}, "p99": {"max": 21}, "p999": {"max": 32}, "max": {"max": 56}},
    "state_hash": "fedcba9876543210"})")
                  .empty());
}

TEST(Expectation, EveryRangeIsCompared) {
  for (const char* key : {"path_length_mm", "duration_s", "smoothness_sparc", "ticks",
                          "missed_ticks", "realtime_factor"}) {
    const auto lines = deviations(std::string("{\"") + key + R"(": {"value": 7e7, "abs": 1}})");
    ASSERT_EQ(lines.size(), 1u) << key;
    EXPECT_EQ(lines[0].rfind(key, 0), 0u) << lines[0];
  }
  for (const char* key : {"p50", "p99", "p999", "max"})
    EXPECT_EQ(deviations(std::string(R"({"tick_us": {")") + key + R"(": {"max": 9}}})").size(), 1u);
  for (const char* key :
       {"first_contact_s", "contact_time_s", "peak_force_n", "mean_force_n", "deepest_mm"}) {
    const auto lines =
        deviations(std::string(R"({"bones": {"lunate": {")") + key + R"(": {"min": 6}}}})");
    ASSERT_EQ(lines.size(), 1u) << key;
    EXPECT_NE(lines[0].find(std::string("lunate ") + key), std::string::npos) << lines[0];
  }
}

TEST(Expectation, TheEndsOfARangeBelongToIt) {
  EXPECT_TRUE(deviations(R"({"path_length_mm": {"min": 812.5, "max": 812.5}})").empty());
  EXPECT_EQ(deviations(R"({"path_length_mm": {"min": 812.6}})").size(), 1u);
  EXPECT_EQ(deviations(R"({"path_length_mm": {"max": 812.4}})").size(), 1u);
}

TEST(Expectation, ARelativeToleranceWorksBelowZero) {
  EXPECT_TRUE(deviations(R"({"smoothness_sparc": {"value": -7, "rel": 0.1}})").empty());
  EXPECT_EQ(deviations(R"({"smoothness_sparc": {"value": -6, "rel": 0.1}})").size(), 1u);
}

TEST(Expectation, AValueThatIsNoNumberIsInNoRange) {
  Report report = sample_report();
  report.path_length_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(deviations(R"({"path_length_mm": {"min": 0}})", report).size(), 1u);
}

TEST(Expectation, SaysWhichBonesWereAndWereNotTouched) {
  auto lines = deviations(R"({"touched": ["radius", "hamate"]})");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "hamate was never touched");
  lines = deviations(R"({"untouched": ["lunate", "hamate"]})");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "lunate was touched at 4 s, expected never");
  lines = deviations(R"({"touched": ["radius"], "untouched": "all_others"})");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "lunate was touched at 4 s, expected never");
}

TEST(Expectation, RangesOfAnUntouchedBoneAreOneDeviation) {
  const auto lines = deviations(
      R"({"bones": {"hamate": {"peak_force_n": {"max": 3}, "deepest_mm": {"max": 1}}}})");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0], "hamate was never touched");
}

TEST(Expectation, SaysWhichOrderIsWrong) {
  const auto lines = deviations(R"({"order": ["lunate", "radius"]})");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("radius was touched before lunate"), std::string::npos);
  EXPECT_EQ(deviations(R"({"order": ["radius", "hamate"]})").size(), 1u);
}

TEST(Expectation, ComparesCaseAndHash) {
  EXPECT_EQ(deviations(R"({"case": "knee"})").size(), 1u);
  EXPECT_EQ(deviations(R"({"state_hash": "fedcba9876543211"})").size(), 1u);
}

}  // namespace
}  // namespace osteon
