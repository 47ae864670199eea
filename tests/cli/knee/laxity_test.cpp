// osteon case laxity and osteon case isometry, through the command line alone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "../run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

class LaxityByHand : public CliTest {
 protected:
  static Json laxity(const std::string& arguments) {
    const Ran ran = run_osteon("case laxity " + arguments + " --json");
    EXPECT_EQ(ran.exit_code, 0) << arguments << "\n" << ran.output;
    return ran.exit_code == 0 ? Json::parse(ran.output) : Json();
  }
  std::string made(const std::string& name, const std::string& options) const {
    const Ran ran = run_osteon("anatomy make knee " + options + " --out " + file(name));
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    return file(name);
  }
  static double pull(const Json& report, const std::string& ligament) {
    for (const Json& pull : report["ligaments"])
      if (pull["name"] == ligament) return pull["tension_n"];
    ADD_FAILURE() << "no " << ligament;
    return 0;
  }
  /// What an arthrometer finds: whole 3 to 6 mm, torn 8 or more, a graft within 3 mm of whole.
  static void expect_clinical(const std::string& knee) {
    const Json torn = laxity(knee + " --test lachman --without acl");
    ASSERT_TRUE(torn.is_object()) << knee;
    EXPECT_TRUE(torn["converged"]);
    const double whole_mm = torn["whole_anterior_mm"];
    EXPECT_GT(whole_mm, 3) << knee;
    EXPECT_LT(whole_mm, 6) << knee;
    EXPECT_GT(torn["anterior_mm"], 8) << knee;
    EXPECT_LT(torn["anterior_mm"], 20) << knee;
    EXPECT_GT(torn["side_difference_mm"], 5) << knee;
    const Json graft = laxity(knee + " --test lachman --graft");
    ASSERT_TRUE(graft.is_object()) << knee;
    EXPECT_LT(std::abs(graft["side_difference_mm"].get<double>()), 3) << knee;
    EXPECT_GT(pull(graft, "graft"), 100) << knee;
  }
};

TEST_F(LaxityByHand, BadInputIsToldAndExitsTwo) {
  const Ran gone = run_osteon("case laxity " + file("nowhere") + " --test lachman");
  EXPECT_EQ(gone.exit_code, 2);
  const Ran wrist = run_osteon("case laxity builtin:wrist --test lachman");
  EXPECT_EQ(wrist.exit_code, 2);
  EXPECT_NE(wrist.output.find("it has no femur"), std::string::npos) << wrist.output;
  EXPECT_EQ(run_osteon("case laxity builtin:knee --test jump").exit_code, 2);
  const Ran other = run_osteon("case laxity builtin:knee --test lachman --without achilles");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.output.find("posterior_capsule"), std::string::npos) << other.output;
  EXPECT_EQ(run_osteon("case laxity builtin:knee --graft-tension 50").exit_code, 2);
  const Ran cut = run_osteon(
      "case laxity builtin:knee --test lachman --without acl --without pcl --without mcl --without "
      "deep_mcl --without posterior_oblique --without lcl --without popliteofibular --without "
      "anterolateral --without posterior_capsule");
  EXPECT_EQ(cut.exit_code, 2);
  EXPECT_NE(cut.output.find("nothing holds the tibia"), std::string::npos) << cut.output;
  EXPECT_EQ(run_osteon("case isometry builtin:knee --from 1,2 --to 3,4,5").exit_code, 2);
}

TEST_F(LaxityByHand, TheBuiltInKneeGivesAsClinicsExpect) { expect_clinical("builtin:knee"); }

TEST_F(LaxityByHand, SoDoRandomPatients) {
  const int last = std::getenv("OSTEON_LONG") ? 5 : 1;
  for (int seed = 1; seed <= last; ++seed)
    expect_clinical(made("knee_" + std::to_string(seed), "--seed " + std::to_string(seed)));
}

TEST_F(LaxityByHand, EveryTestMovesTheKneeItsWayAndATearMakesItLooser) {
  const Json report = laxity("builtin:knee --without acl");
  const Json whole = laxity("builtin:knee");
  ASSERT_EQ(report["tests"].size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(whole["tests"][i]["converged"]) << i;
    EXPECT_TRUE(report["tests"][i]["converged"]) << i;
  }
  const auto test = [&](const Json& of, const std::string& name) {
    for (const Json& t : of["tests"])
      if (t["test"] == name) return t;
    return Json();
  };
  EXPECT_EQ(test(whole, "lachman")["flexion_deg"], 30);
  EXPECT_EQ(test(whole, "lachman")["load_n"], 134);
  EXPECT_GT(pull(test(whole, "lachman"), "acl"), 60);
  EXPECT_EQ(pull(test(report, "lachman"), "acl"), 0);
  EXPECT_EQ(test(whole, "drawer")["flexion_deg"], 90);
  EXPECT_GT(test(whole, "drawer")["anterior_mm"], 3);
  EXPECT_LT(test(whole, "drawer")["anterior_mm"], 7);
  EXPECT_GT(test(report, "drawer")["side_difference_mm"], 2);
  EXPECT_GT(test(whole, "pivot")["internal_rotation_deg"], 5);
  EXPECT_GT(test(report, "pivot")["side_difference_mm"], 2);
  EXPECT_EQ(test(whole, "varus")["load_nm"], 10);
  EXPECT_GT(test(whole, "varus")["varus_deg"], 1);
  EXPECT_LT(test(whole, "varus")["varus_deg"], 8);
  EXPECT_GT(pull(test(whole, "varus"), "lcl"), 20);
  EXPECT_LT(test(whole, "valgus")["varus_deg"], -1);
  EXPECT_GT(test(whole, "valgus")["varus_deg"], -8);
  EXPECT_GT(pull(test(whole, "valgus"), "deep_mcl") + pull(test(whole, "valgus"), "mcl"), 60);
}

TEST_F(LaxityByHand, ATearOfTheCaseCountsAndTheLeftKneeMirrorsTheRight) {
  const std::string left = made("left", "--side left");
  const std::string torn = made("torn", "--finding acl_tear=midsubstance");
  const Json right_mm = laxity("builtin:knee --test lachman --without acl");
  const Json torn_mm = laxity(torn + " --test lachman");
  const Json left_mm = laxity(left + " --test lachman --without acl");
  EXPECT_EQ(pull(torn_mm, "acl"), 0);
  EXPECT_EQ(left_mm["side"], "left");
  for (const char* key :
       {"anterior_mm", "whole_anterior_mm", "internal_rotation_deg", "varus_deg"}) {
    EXPECT_NEAR(left_mm[key], right_mm[key].get<double>(), 0.1) << key;
    EXPECT_NEAR(torn_mm[key], right_mm[key].get<double>(), 0.3) << key;
  }
}

TEST_F(LaxityByHand, ALineBetweenFixedPlacesKeepsItsLengthAsTheBonesGo) {
  // The footprints of the anterior cruciate ligament.
  const std::string ends =
      "case isometry builtin:knee --from=-23.5,-13.1,-12.2 --to 4.1,1,0 --json";
  const Ran ran = run_osteon(ends);
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Json report = Json::parse(ran.output);
  ASSERT_EQ(report["lengths"].size(), 14u);
  const double straight = std::sqrt(27.6 * 27.6 + 14.1 * 14.1 + 12.2 * 12.2);
  EXPECT_NEAR(report["lengths"][0]["length_mm"], straight, 1e-6);
  EXPECT_EQ(report["lengths"][13]["flexion_deg"], 130);
  EXPECT_GT(report["shortest_mm"], 0.7 * straight);
  EXPECT_LT(report["longest_mm"], 1.05 * straight);
  EXPECT_NEAR(report["excursion_mm"].get<double>(),
              report["longest_mm"].get<double>() - report["shortest_mm"].get<double>(), 1e-9);
}

}  // namespace
}  // namespace osteon::testing_cli
