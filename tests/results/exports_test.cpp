#include "osteon/results/exports.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "osteon/base/file.h"

namespace osteon {
namespace {

AttemptRow sample_row() {
  AttemptRow row;
  row.id = "0a1b2c3d-0000-4000-8000-00000000000f";
  row.learner = "seat-3.b";
  row.scenario = "touch_bones";
  row.verdict = "passed";
  row.score = 150;
  row.score_lo = 140.25;
  row.score_hi = 159.75;
  row.ended_ms = 1706702709123;  // 2024-01-31T12:05:09.123Z
  row.duration_s = 61.254;
  row.case_name = "wrist, \"left\"";
  row.state_hash = "00000000000000ff";
  row.report_json = "{}";
  return row;
}

TEST(Uuid, IsOfVersionFourAndNewEachTime) {
  const std::string a = new_uuid();
  EXPECT_TRUE(is_uuid(a)) << a;
  EXPECT_EQ(a[14], '4');
  EXPECT_NE(a, new_uuid());
  EXPECT_FALSE(is_uuid("0a1b2c3d-0000-4000-8000-00000000000"));
  EXPECT_FALSE(is_uuid("0a1b2c3d-0000-4000-8000-00000000000g"));
}

TEST(LearnerId, IsNoName) {
  EXPECT_TRUE(is_learner_id("local"));
  EXPECT_FALSE(is_learner_id(""));
  EXPECT_FALSE(is_learner_id("Ada Lovelace"));
  EXPECT_FALSE(is_learner_id(std::string(65, 'a')));
}

TEST(AttemptRow, ComesBackFromItsJson) {
  const auto row = parse_attempt_row(to_json(sample_row()), "x");
  ASSERT_TRUE(row) << row.error().message();
  EXPECT_EQ(*row, sample_row());
  EXPECT_FALSE(parse_attempt_row("{}", "x"));
  EXPECT_FALSE(parse_attempt_row("{\"id\": 3}", "x"));
  EXPECT_FALSE(row_from_report("{}", "local"));
  EXPECT_FALSE(row_from_report("", "local"));
}

TEST(Csv, QuotesWhatNeedsIt) {
  const std::string text = to_csv({sample_row()});
  EXPECT_NE(text.find("0a1b2c3d-0000-4000-8000-00000000000f,seat-3.b,touch_bones,1,0,passed,150,"
                      "140.25,159.75,2024-01-31T12:05:09.123Z,61.254,\"wrist, \"\"left\"\"\","
                      "00000000000000ff\r\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(to_csv({}).find("id,learner,scenario"), 0u);
}

TEST(Xapi, StatementsAreOfVersion103) {
  AttemptRow open = sample_row();
  open.verdict = "undecided";
  open.score = std::nullopt;
  AttemptRow failed = sample_row();
  failed.verdict = "not_passed";
  failed.score = -250;
  const auto list = nlohmann::json::parse(to_xapi({sample_row(), open, failed}));
  ASSERT_EQ(list.size(), 3u);
  const auto& s = list[0];
  EXPECT_EQ(s["id"], sample_row().id);
  EXPECT_EQ(s["version"], "1.0.3");
  EXPECT_EQ(s["actor"]["account"]["name"], "seat-3.b");
  EXPECT_EQ(s["verb"]["id"], "http://adlnet.gov/expapi/verbs/passed");
  EXPECT_EQ(s["object"]["definition"]["type"], "http://adlnet.gov/expapi/activities/simulation");
  EXPECT_EQ(s["result"]["score"]["scaled"], 1.0);
  EXPECT_EQ(s["result"]["success"], true);
  EXPECT_EQ(s["result"]["duration"], "PT61.25S");
  EXPECT_EQ(s["timestamp"], "2024-01-31T12:05:09.123Z");
  EXPECT_FALSE(list[1]["result"].contains("score"));
  EXPECT_FALSE(list[1]["result"].contains("success"));
  EXPECT_EQ(list[2]["verb"]["id"], "http://adlnet.gov/expapi/verbs/failed");
  EXPECT_EQ(list[2]["result"]["score"]["scaled"], -1.0);
}

TEST(ResultsPdf, HasPagesForManyAttempts) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("osteon_pdf_" + std::to_string(::getpid()) + ".pdf");
  ASSERT_TRUE(save_results_pdf(std::vector<AttemptRow>(200, sample_row()), file));
  const std::string bytes = *read_file(file);
  std::filesystem::remove(file);
  EXPECT_EQ(bytes.substr(0, 5), "%PDF-");
  EXPECT_NE(bytes.find("%%EOF"), std::string::npos);
  EXPECT_NE(bytes.find("/Count 4"), std::string::npos);
  EXPECT_FALSE(save_results_pdf({}, "/nowhere/x.pdf"));
}

}  // namespace
}  // namespace osteon
