// osteon case acl, through the command line alone.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "../run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

class AclTunnelsCommand : public CliTest {
 protected:
  static Json measured(const std::string& arguments) {
    const Ran ran = run_osteon("case acl builtin:knee --json " + arguments);
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    return ran.exit_code == 0 ? Json::parse(ran.output) : Json();
  }
};

constexpr const char* kGoodFemur = "--femur-from=-5.5,1.9,-30.8 --femur-to=-38.5,-25.6,3.3 ";
constexpr const char* kGoodTibia = "--tibia-from=50,18,22 --tibia-to=4.1,1,0 ";

TEST_F(AclTunnelsCommand, BadInputIsToldAndExitsTwo) {
  const Ran none = run_osteon("case acl builtin:knee");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.output.find("no tunnel is given"), std::string::npos) << none.output;
  EXPECT_EQ(run_osteon("case acl builtin:knee --femur-from 0,0,0").exit_code, 2);
  EXPECT_EQ(run_osteon("case acl builtin:knee --femur-from 0,0,nan --femur-to 1,2,3").exit_code, 2);
  EXPECT_EQ(run_osteon("case acl " + file("nowhere") + " " + kGoodTibia).exit_code, 2);
}

// The built-in knee's footprints were laid where the publications have them: depth 24.8 %, height
// 28.5 % of the quadrant, and 40.9 % of the plateau.
TEST_F(AclTunnelsCommand, AtTheFootprintsTheKneeIsHeldAsBefore) {
  const Json good = measured(std::string(kGoodFemur) + kGoodTibia);
  ASSERT_TRUE(good.is_object());
  EXPECT_NEAR(good["femur"]["depth_pct"], 24.8, 3);
  EXPECT_NEAR(good["femur"]["height_pct"], 28.5, 3);
  EXPECT_LT(good["femur"]["off_target_mm"], 1.5);
  EXPECT_FALSE(good["femur"]["blow_out"]);
  EXPECT_GT(good["femur"]["channel_mm"], good["femur"]["drilled_mm"]);
  EXPECT_NEAR(good["tibia"]["amis_jakob_pct"], 40.9, 5);
  EXPECT_FALSE(good["impingement"]["impinges"]);
  EXPECT_TRUE(good["tibia"]["through"]);
  EXPECT_TRUE(good["lachman"]["converged"]);
  EXPECT_LT(std::abs(good["lachman"]["side_difference_mm"].get<double>()), 3);
  EXPECT_GT(good["isometry"]["excursion_mm"], 0.5);
  // A socket that was drilled in a bent knee turns the graft most in the knee stretched out.
  const Json& bending = good["bending"];
  ASSERT_EQ(bending.size(), good["isometry"]["lengths"].size());
  EXPECT_EQ(bending[9]["flexion_deg"], 90);
  EXPECT_GT(bending[0]["femur_deg"].get<double>(), bending[9]["femur_deg"].get<double>() + 20);
  EXPECT_LT(bending[0]["tibia_deg"].get<double>(), bending[9]["tibia_deg"].get<double>());
}

std::string on_line(const Json& through, const Json& other, double away_mm) {
  double from[3], step[3], length = 0;
  for (int k = 0; k < 3; ++k) {
    from[k] = through[k];
    step[k] = from[k] - other[k].get<double>();
    length += step[k] * step[k];
  }
  std::string text;
  for (int k = 0; k < 3; ++k)
    text += (k ? "," : "") + std::to_string(from[k] + away_mm * step[k] / std::sqrt(length));
  return text;
}

// Two tunnels on one line through the knee as it lies, stretched out: the graft turns nowhere.
TEST_F(AclTunnelsCommand, AGraftOnOneLineWithBothTunnelsDoesNotTurn) {
  const Json femur = Json::array({-23.5, -13.1, -12.2}), tibia = Json::array({4.2, 1.0, 0.0});
  const Json line = measured(
      "--femur-from=" + on_line(femur, tibia, -10) + " --femur-to=" + on_line(femur, tibia, 20) +
      " --tibia-from=" + on_line(tibia, femur, 60) + " --tibia-to=" + on_line(tibia, femur, 0));
  ASSERT_TRUE(line.is_object());
  EXPECT_LT(line["bending"][0]["femur_deg"], 0.01);
  EXPECT_LT(line["bending"][0]["tibia_deg"], 0.01);
  EXPECT_GT(line["bending"][9]["femur_deg"], 30);
}

// A socket under the roof, and a tibial tunnel far in front.
TEST_F(AclTunnelsCommand, ClassicFaultsShow) {
  const Json bad = measured(
      "--femur-from=15.5,33.5,-48 --femur-to=-37.3,-20.6,8 "
      "--tibia-from=60,14,14 --tibia-to=1,1,15");
  ASSERT_TRUE(bad.is_object());
  EXPECT_LT(bad["femur"]["height_pct"], 15);
  EXPECT_LT(bad["femur"]["from_roof_deg"], 55);
  EXPECT_GT(bad["femur"]["off_target_mm"], 4);
  EXPECT_LT(bad["tibia"]["amis_jakob_pct"], 25);
  EXPECT_TRUE(bad["impingement"]["impinges"]);
}

TEST_F(AclTunnelsCommand, ALineBesideItsBoneIsRefused) {
  const Ran missed = run_osteon("case acl builtin:knee --femur-from 200,0,0 --femur-to 210,0,0");
  EXPECT_EQ(missed.exit_code, 2);
  EXPECT_NE(missed.output.find("misses the bone"), std::string::npos) << missed.output;
}

}  // namespace
}  // namespace osteon::testing_cli
