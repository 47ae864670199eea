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
  EXPECT_FALSE(json.contains("screw"));
  report.bent.lengths_m[0] = 0.030;
  report.bent.lengths_m[9] = 0.034;
  report.state.screw = {1, Vec3::Zero(), Vec3::UnitZ(), 0.009, 0.025, 0.024, true, 90, 30, 25};
  const Vec3 out_B = (report.plan.tibia.outer_B - report.plan.tibia.mouth_B).normalized();
  report.state.screw.out_B = out_B;
  const auto fixed = to_json(report);
  EXPECT_NEAR(fixed["bent_excursion_mm"].get<double>(), 4, 1e-9);
  EXPECT_EQ(fixed["bent"].size(), 2u);
  EXPECT_EQ(fixed["bent"][1]["flexion_deg"], 90);
  EXPECT_NEAR(fixed["screw"]["deep_mm"].get<double>(), 24, 1e-9);
  EXPECT_NEAR(fixed["screw"]["divergence_deg"].get<double>(), 0, 1e-4);
  EXPECT_EQ(fixed["screw"]["cycles"], 25);
  EXPECT_NE(to_text(report).find("screw: depth"), std::string::npos);
}

}  // namespace
}  // namespace osteon
