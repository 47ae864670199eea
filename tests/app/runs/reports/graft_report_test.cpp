#include "runs/reports/graft_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../../../graft_bench_case.h"

namespace osteon {
namespace {

GraftReport hung_graft() {
  GraftReport report{*find_graft_bench(*testing::bench_case()), testing::folded_bench(2, 2)};
  report.state.creep_s = 600;
  report.state.passed_m = 0.008;
  report.state.loop_m = 0.020;
  return report;
}

TEST(GraftReports, WhatWasMadeReadsBack) {
  const GraftReport report = hung_graft();
  const nlohmann::ordered_json whole{{"acl", {{"graft", to_json(report)}}}};
  for (const std::string& text : {whole.dump(), to_json(report).dump()}) {
    const auto made = made_graft(text, "here");
    ASSERT_TRUE(made) << made.error().message();
    EXPECT_NEAR(made->length_m, 0.125, 1e-9);
    EXPECT_NEAR(made->diameter_m, 0.0079, 1e-4);
    EXPECT_NEAR(made->loop_m, 0.020, 1e-9);
    EXPECT_NEAR(made->creep_s, 600, 1e-9);
  }
  EXPECT_NE(to_text(report).find("graft in the socket"), std::string::npos);
}

TEST(GraftReports, OfAWholeReconstructionWhatWasMadeIsRead) {
  const nlohmann::ordered_json whole{
      {"acl", {{"made", to_json(hung_graft())}, {"graft", {{"holds", true}}}}}};
  const auto made = made_graft(whole.dump(), "here");
  ASSERT_TRUE(made) << made.error().message();
  EXPECT_NEAR(made->length_m, 0.125, 1e-9);
}

TEST(GraftReports, WhatIsMissingOrOutOfRangeIsNamed) {
  EXPECT_FALSE(made_graft("[", "here"));
  EXPECT_FALSE(made_graft("[1]", "here"));
  GraftReport report = hung_graft();
  report.state.loop_m = 0;  // no button hangs on it
  const auto bare = made_graft(to_json(report).dump(), "here");
  ASSERT_FALSE(bare);
  EXPECT_NE(bare.error().message().find("loop_mm"), std::string::npos);
  EXPECT_FALSE(made_graft(R"({"length_mm": 1e9})", "here"));
  report.state = {};
  EXPECT_NE(to_text(report).find("no graft"), std::string::npos);
}

}  // namespace
}  // namespace osteon
