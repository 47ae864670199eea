#include "runs/reports/placing_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../../../placing_case.h"

namespace osteon {
namespace {

TEST(PlacingReports, SayWhatBecameOfThreadAndButton) {
  PlacingReport report{*find_placing(*testing::placing_knee()), {}};
  report.state.on = true;
  EXPECT_EQ(to_json(report)["thread"], "none");
  EXPECT_FALSE(to_json(report)["button_turned"].get<bool>());
  EXPECT_TRUE(to_json(report)["gap_mm"].is_null());
  EXPECT_NE(to_text(report).find("has not turned"), std::string::npos);
  report.state.phase = PlacingPhase::kTurned;
  report.state.gap_m = 0.003;
  report.state.lost = 2;
  const auto json = to_json(report);
  EXPECT_NEAR(json["gap_mm"].get<double>(), 3, 1e-9);
  EXPECT_NEAR(json["in_socket_mm"].get<double>(), 23, 1e-6);
  EXPECT_EQ(json["thread_lost"], 2);
  EXPECT_NE(to_text(report).find("gap to the cortex"), std::string::npos);
}

}  // namespace
}  // namespace osteon
