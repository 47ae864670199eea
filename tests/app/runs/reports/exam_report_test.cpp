#include "runs/reports/exam_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace osteon {
namespace {

TEST(ExamReports, SayWhatWasNotDone) {
  const auto json = to_json(KneeExam{});
  for (const char* knee : {"found", "grafted"})
    for (const char* test : {"lachman", "pivot"}) EXPECT_TRUE(json[knee][test].is_null());
  EXPECT_NE(to_text(KneeExam{}).find("pivot shift by hand, with the graft"), std::string::npos);
  EXPECT_NE(to_text(KneeExam{}).find("not done"), std::string::npos);
}

TEST(ExamReports, SayWhatWasFoundAndUnderWhichLoad) {
  KneeExam exam;
  exam.front_n = 134;
  exam.valgus_nm = 10;
  exam.internal_nm = 4;
  exam.found[0][0] = {30, 1, 0.014, 0.005};
  exam.found[1][1] = {5, 0.5, 0.004, 0.003};
  const auto json = to_json(exam);
  const auto& lachman = json["found"]["lachman"];
  EXPECT_EQ(lachman["force_n"], 134);
  EXPECT_EQ(lachman["flexion_deg"], 30);
  EXPECT_NEAR(lachman["anterior_mm"].get<double>(), 14, 1e-9);
  EXPECT_NEAR(lachman["whole_anterior_mm"].get<double>(), 5, 1e-9);
  EXPECT_NEAR(lachman["side_difference_mm"].get<double>(), 9, 1e-9);
  EXPECT_FALSE(lachman.contains("valgus_nm"));
  const auto& pivot = json["grafted"]["pivot"];
  EXPECT_EQ(pivot["valgus_nm"], 5);
  EXPECT_EQ(pivot["internal_nm"], 2);
  EXPECT_TRUE(json["found"]["pivot"].is_null());
  EXPECT_NE(to_text(exam).find("14.0 mm at 30 degrees, 9.0 more than intact"), std::string::npos);
}

}  // namespace
}  // namespace osteon
