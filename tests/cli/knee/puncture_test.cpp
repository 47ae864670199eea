// Making both portals of a knee, through the command line alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "../run_osteon.h"

namespace osteon::testing_cli {
namespace {

using PunctureJson = nlohmann::json;

class PunctureCommands : public CliTest {
 protected:
  PunctureJson report(const std::string& arguments, int exit_code) {
    const Ran ran = run_osteon("run acl_puncture --no-store --report " + file("puncture.json") +
                               " " + arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << ran.output;
    std::ifstream in(file("puncture.json"));
    return PunctureJson::parse(in, nullptr, false);
  }
};

TEST_F(PunctureCommands, TheExpertMakesBothPortalsAndTheRecordingRepeats) {
  const PunctureJson json = report("--seed 0 --record " + file("p.osr"), 0);
  EXPECT_TRUE(json["errors"].empty()) << json["errors"];
  EXPECT_NEAR(json["duration_s"], 34.1, 1);
  const PunctureJson& worker = json["hands"]["worker"]["portals"];
  const PunctureJson& scope = json["hands"]["scope"]["portals"];
  EXPECT_EQ(worker["portal_al_made_1"]["times_entered"], 1);
  EXPECT_EQ(worker["portal_am_made_1"]["times_entered"], 2);  // with the trocar and with the hook
  EXPECT_EQ(scope["portal_al_made_1"]["times_entered"], 1);
  EXPECT_FALSE(scope.contains("portal_am_made_1")) << scope;
  EXPECT_FALSE(worker.contains("portal_al_made_2")) << worker;
  for (const char* from : {"", "--from 3 ", "--from 22 "}) {
    const Ran again = run_osteon("replay " + std::string(from) + file("p.osr"));
    EXPECT_EQ(again.exit_code, 0) << from << again.output;
  }
  const Ran events = run_osteon("record info --events " + file("p.osr"));
  for (const char* portal : {"portal_al_made_1", "portal_am_made_1"})
    EXPECT_NE(events.output.find("portal_made  portal " + std::string(portal)), std::string::npos);
}

TEST_F(PunctureCommands, APlaceThatTheCaseLacksIsNamedByTheCheck) {
  std::ifstream in(OSTEON_SOURCE_DIR "/assets/scenarios/acl_puncture.toml");
  std::string text(std::istreambuf_iterator<char>(in), {});
  const std::string name = "skin:portal_am";
  text.replace(text.find(name), name.size(), "skin:elbow");
  std::ofstream(file("elbow.toml")) << text;
  const Ran ran = run_osteon("scenario check " + file("elbow.toml"));
  EXPECT_EQ(ran.exit_code, 1) << ran.output;
  EXPECT_NE(ran.output.find("elbow"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("skin:portal_al"), std::string::npos) << ran.output;
}

TEST_F(PunctureCommands, TheExpertPassesOnManyPatients) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "set OSTEON_LONG=1";
  for (int seed = 1; seed < 10; ++seed) (void)report("--seed " + std::to_string(seed), 0);
}

}  // namespace
}  // namespace osteon::testing_cli
