// Making a graft and what it does in a knee, through the command line alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "../run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

class GraftCommands : public CliTest {
 protected:
  Json report(const std::string& arguments, int exit_code, const std::string& name = "graft.json") {
    const Ran ran = run_osteon("run acl_graft --no-store --report " + file(name) + " " + arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << ran.output;
    std::ifstream in(file(name));
    return Json::parse(in, nullptr, false);
  }
  Json in_knee(const std::string& arguments) {
    const Ran ran = run_osteon(
        "case acl builtin:knee --json --femur-from=-5.5,1.9,-30.8 --femur-to=-38.5,-25.6,3.3 "
        "--tibia-from=50,18,22 --tibia-to=4.1,1,0 " +
        arguments);
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    return ran.exit_code == 0 ? Json::parse(ran.output) : Json();
  }
};

TEST_F(GraftCommands, TheExpertMakesAGraftOfEachPatientsTendonsThatRepeats) {
  for (int seed = 0; seed < (std::getenv("OSTEON_LONG") ? 20 : 1); ++seed) {
    const Json json = report(
        "--seed " + std::to_string(seed) + " --record " + file("g" + std::to_string(seed) + ".osr"),
        0);
    const Json& graft = json["acl"]["graft"];
    EXPECT_TRUE(json["errors"].empty()) << json["errors"];
    EXPECT_NEAR(graft["sizer_mm"].get<double>(), graft["sizer_found_mm"].get<double>(), 1e-6);
    EXPECT_GE(graft["sizer_mm"].get<double>(), 7.99);
    EXPECT_GE(graft["in_socket_mm"].get<double>(), 14);
    EXPECT_LT(graft["creep_left_pct"].get<double>(), 10);
    EXPECT_GE(graft["pretension_s"].get<double>(), 600);
    EXPECT_EQ(graft["tendons"][0]["length_mm"], graft["tendons"][0]["harvested_mm"]);
  }
  const Ran again = run_osteon("replay " + file("g0.osr"));
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_EQ(run_osteon("replay --from 80 " + file("g0.osr")).exit_code, 0);
}

TEST_F(GraftCommands, AnAmputatedTendonEndsInAKneeThatNothingHolds) {
  (void)report("--seed 1 --surgeon bad:amputated_tendon", 1, "short.json");
  const Json lost = in_knee("--graft " + file("short.json"));
  EXPECT_FALSE(lost["graft"]["fixed"]);
  EXPECT_GT(lost["lachman"]["side_difference_mm"], 5);
}

TEST_F(GraftCommands, ADivergentScrewAndASlackGraftLetTheTibiaForward) {
  const Json whole = in_knee("--cycles 25");
  EXPECT_TRUE(whole["graft"]["holds"]);
  EXPECT_LT(whole["lachman"]["side_difference_mm"].get<double>(), 3);
  EXPECT_TRUE(whole["passing"]["button_turns"]);
  const double pull_n = whole["passing"]["most_pull_n"];
  EXPECT_GT(pull_n, 10);  // more than the tail's
  const double good = whole["lachman"]["ahead_of_whole_mm"];
  const Json screw = in_knee("--screw-divergence 30 --tail 40");
  EXPECT_GT(screw["passing"]["most_pull_n"], pull_n + 30);
  EXPECT_GT(screw["lachman"]["ahead_of_whole_mm"].get<double>(), good + 2);
  EXPECT_LT(screw["graft"]["strength_n"], 200);
  const Json slack = in_knee("--pretension 0 --cycles 0 --tension 20");
  EXPECT_GT(slack["lachman"]["ahead_of_whole_mm"].get<double>(), good + 2);
}

TEST_F(GraftCommands, BadInputIsToldAndExitsTwo) {
  const std::string knee =
      "case acl builtin:knee --femur-from=-5.5,1.9,-30.8 --femur-to=-38.5,-25.6,3.3 "
      "--tibia-from=50,18,22 --tibia-to=4.1,1,0 ";
  const Ran screw = run_osteon(knee + "--screw nine");
  EXPECT_EQ(screw.exit_code, 2);
  EXPECT_NE(screw.output.find("like 9x28"), std::string::npos) << screw.output;
  const Ran thick = run_osteon(knee + "--graft-diameter 10");
  EXPECT_EQ(thick.exit_code, 2);
  EXPECT_NE(thick.output.find("does not pass"), std::string::npos) << thick.output;
  const Ran bent = run_osteon(knee + "--passing-flexion 150");
  EXPECT_EQ(bent.exit_code, 2);
  EXPECT_NE(bent.output.find("--passing-flexion"), std::string::npos) << bent.output;
  std::ofstream(file("empty.json")) << "{}";
  const Ran empty = run_osteon(knee + "--graft " + file("empty.json"));
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_NE(empty.output.find("length_mm"), std::string::npos) << empty.output;
  std::ofstream(file("odd.json")) << R"({"length_mm": -1, "diameter_mm": 8})";
  EXPECT_EQ(run_osteon(knee + "--graft " + file("odd.json")).exit_code, 2);
  EXPECT_EQ(run_osteon("case acl-faults --knees 0").exit_code, 2);
}

TEST_F(GraftCommands, TheTableOfFaultsTellsThemApart) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "set OSTEON_LONG=1";
  const Ran ran = run_osteon("case acl-faults --knees 3 --json");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Json rows = Json::parse(ran.output);
  ASSERT_EQ(rows.size(), 8u);
  const auto median = [&](std::size_t row, const char* key) {
    return rows[row][key]["median"].get<double>();
  };
  EXPECT_EQ(rows[0]["fault"], "none");
  EXPECT_LT(median(0, "lachman_difference_mm"), 3);
  EXPECT_LT(median(1, "graft_excursion_mm"), median(0, "graft_excursion_mm"));
  EXPECT_GT(median(1, "pivot_difference_mm"), median(0, "pivot_difference_mm"));
  EXPECT_GT(median(6, "lachman_difference_mm"), 3);
  // Classic faults of the tunnels lie outside of what good ones give.
  EXPECT_TRUE(rows[0]["outside_good"].empty());
  const auto is_outside = [&](std::size_t row, const char* key) {
    const Json& outside = rows[row]["outside_good"];
    return std::find(outside.begin(), outside.end(), key) != outside.end();
  };
  for (const char* key : {"lachman_difference_mm", "graft_excursion_mm", "roof_gap_mm"})
    EXPECT_TRUE(is_outside(1, key)) << key << rows[1];
  for (const char* key : {"lachman_difference_mm", "lachman_ahead_mm"})
    EXPECT_TRUE(is_outside(2, key)) << key << rows[2];
}

}  // namespace
}  // namespace osteon::testing_cli
