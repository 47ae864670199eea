// Faulty tunnels of an earlier reconstruction: found, and drilled anew, through the command line.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "../run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

bool is_long() { return std::getenv("OSTEON_LONG") != nullptr; }

class SecondLookCli : public CliTest {
 protected:
  Json report(const std::string& arguments, int exit_code) {
    const Ran ran = run_osteon("run acl_second_look --no-store --report " + file("look.json") +
                               " " + arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << ran.output;
    std::ifstream in(file("look.json"));
    return Json::parse(in, nullptr, false);
  }
  // What `osteon case acl` measures of the old tunnels.
  Json measured(int seed, const std::string& socket, const std::string& tunnel) {
    const std::string knee = "builtin:knee:" + std::to_string(seed);
    const Ran ran = run_osteon("case acl " + knee + " --drilled " + knee + ":old_socket=" + socket +
                               ":old_tunnel=" + tunnel + " --json");
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    return Json::parse(ran.output, nullptr, false);
  }
  // By the measure alone.
  static std::string socket_of(const Json& femur) {
    if (femur["diameter_mm"] < 6 || femur["drilled_mm"] < 18) return "short";
    if (femur["from_roof_deg"] < 55) return "steep";
    return femur["depth_pct"] > 40 ? "front" : "sound";
  }
  static std::string tunnel_of(const Json& tibia) {
    const double share = tibia["amis_jakob_pct"];
    return share < 30 ? "front" : share > 53 ? "back" : "sound";
  }
};

TEST_F(SecondLookCli, AnOldTunnelIsWhatItsMeasureSays) {
  for (int seed = 0; seed < (is_long() ? 12 : 1); ++seed)
    for (const auto& [socket, tunnel] :
         {std::pair("sound", "back"), std::pair("steep", "front"), std::pair("front", "sound"),
          std::pair("short", "sound")}) {
      const Json json = measured(seed, socket, tunnel);
      EXPECT_EQ(socket_of(json["femur"]), socket) << seed << json["femur"];
      EXPECT_EQ(tunnel_of(json["tibia"]), tunnel) << seed << json["tibia"];
    }
}

TEST_F(SecondLookCli, TheExpertMendsWhatIsAtFaultAndTheRecordingRepeats) {
  const Json json = report("--seed 1 --record " + file("look.osr"), 0);
  EXPECT_TRUE(json["errors"].empty()) << json["errors"];
  const Json &before = json["acl"]["before"], &now = json["acl"]["tibia"];
  EXPECT_EQ(tunnel_of(before["tibia"]), "front");
  EXPECT_EQ(socket_of(before["femur"]), "sound");
  // The new one, and not the one that was there.
  EXPECT_EQ(tunnel_of(now), "sound");
  EXPECT_NEAR(now["diameter_mm"].get<double>(), 8, 0.1);
  EXPECT_GT(before["to_new_tibia_mm"], 1);
  EXPECT_TRUE(before["to_new_femur_mm"].is_null());
  EXPECT_EQ(json["acl"]["femur"]["aperture_mm"], before["femur"]["aperture_mm"]);
  EXPECT_LT(json["acl"]["lachman"]["side_difference_mm"], 3);
  EXPECT_EQ(run_osteon("replay --from 60 " + file("look.osr")).exit_code, 0);
  const Ran debrief = run_osteon("debrief " + file("look.osr") + " --out " + file("look.html"));
  EXPECT_EQ(debrief.exit_code, 0) << debrief.output;
}

TEST_F(SecondLookCli, EachFaultIsMended) {
  if (!is_long()) GTEST_SKIP() << "set OSTEON_LONG=1";
  for (int seed = 0; seed < 6; ++seed) {
    const Json json = report("--seed " + std::to_string(seed), 0);
    EXPECT_TRUE(json["errors"].empty()) << seed << json["errors"];
    EXPECT_EQ(socket_of(json["acl"]["femur"]), "sound") << seed;
    EXPECT_EQ(tunnel_of(json["acl"]["tibia"]), "sound") << seed;
    EXPECT_EQ(json["metrics"]["findings_right_percent"], 100);
  }
}

// An error can be made with those patients alone who have the tunnel for it.
TEST_F(SecondLookCli, EachBadSurgeonMakesHisErrorAlone) {
  if (!is_long()) GTEST_SKIP() << "set OSTEON_LONG=1";
  for (const auto& [name, seed] :
       {std::pair("fault_missed", 1), std::pair("sound_blamed", 1), std::pair("scuffed", 1),
        std::pair("sound_socket_drilled", 1), std::pair("sound_tunnel_drilled", 0),
        std::pair("misplaced_socket", 2), std::pair("misplaced_tunnel", 3),
        std::pair("into_old_socket", 2), std::pair("into_old_tunnel", 3),
        std::pair("short_socket", 0), std::pair("no_pin", 3), std::pair("plunged", 3)}) {
    const Json json =
        report("--seed " + std::to_string(seed) + " --surgeon bad:" + std::string(name), 1);
    ASSERT_EQ(json["errors"].size(), 1u) << name << json["errors"];
    EXPECT_EQ(json["errors"][0]["name"], name);
  }
}

TEST_F(SecondLookCli, APatientWithoutTheTunnelGivesNoOccasion) {
  const Ran ran = run_osteon("run acl_second_look --no-store --seed 1 --surgeon bad:short_socket");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.output.find("no occasion"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace osteon::testing_cli
