// Placing a graft by hand, through the command line alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "../run_osteon.h"

namespace osteon::testing_cli {
namespace {

using Json = nlohmann::json;

class PassingCommands : public CliTest {
 protected:
  Json report(const std::string& arguments, int exit_code) {
    const Ran ran =
        run_osteon("run acl_passing --no-store --report " + file("passing.json") + " " + arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << ran.output;
    std::ifstream in(file("passing.json"));
    return Json::parse(in, nullptr, false);
  }
};

TEST_F(PassingCommands, TheExpertPlacesTheGraftAndTheRecordingRepeats) {
  const Json json = report("--seed 0 --record " + file("p.osr"), 0);
  const Json& placing = json["acl"]["placing"];
  EXPECT_TRUE(json["errors"].empty()) << json["errors"];
  EXPECT_TRUE(placing["button_turned"]);
  EXPECT_EQ(placing["gap_mm"], 0);
  EXPECT_EQ(placing["thread_lost"], 0);
  EXPECT_GT(placing["most_pull_n"], 15);
  EXPECT_GT(placing["in_socket_mm"], 10);
  const Ran again = run_osteon("replay --from 15 " + file("p.osr"));
  EXPECT_EQ(again.exit_code, 0) << again.output;
}

TEST_F(PassingCommands, EachBadSurgeonMakesHisErrorAlone) {
  if (!std::getenv("OSTEON_LONG")) GTEST_SKIP() << "set OSTEON_LONG=1";
  for (const std::string name :
       {"lost_thread", "unflipped_button", "soft_tissue", "flipped_in_muscle"}) {
    const Json json = report("--seed 1 --surgeon bad:" + name, 1);
    ASSERT_EQ(json["errors"].size(), 1u) << name;
    EXPECT_EQ(json["errors"][0]["name"], name);
  }
  for (int seed = 1; seed < 10; ++seed) (void)report("--seed " + std::to_string(seed), 0);
}

}  // namespace
}  // namespace osteon::testing_cli
