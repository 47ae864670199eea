// A ligament of the built-in knee, lifted by a hook, cut down by a blade and torn by the hook,
// through the command line.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../run_osteon.h"

namespace osteon::testing_cli {
namespace {

constexpr const char* kTwoHands =
    "simulate --case builtin:knee --hand left=" OSTEON_SOURCE_DIR
    "/assets/paths/knee_ligament_hook.csv --hand right=" OSTEON_SOURCE_DIR
    "/assets/paths/knee_ligament_blade.csv --soft lcl --max-force 40 --hand-stiffness 3000 ";

class LigamentSession : public CliTest {
 protected:
  // Those of one kind, in the order of time.
  std::vector<nlohmann::json> events(const nlohmann::json& soft, const char* kind) const {
    std::vector<nlohmann::json> out;
    std::copy_if(soft["events"].begin(), soft["events"].end(), std::back_inserter(out),
                 [&](const nlohmann::json& event) { return event["kind"] == kind; });
    return out;
  }
};

TEST_F(LigamentSession, IsHookedCutDownAndTornAndItsRecordingReplays) {
  const Ran ran =
      run_osteon(kTwoHands + ("--record " + file("run.osr")) + " --report " + file("report.json"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto report = nlohmann::json::parse(std::ifstream(file("report.json")), nullptr, false);
  const nlohmann::json soft = report["soft"];
  ASSERT_EQ(soft["parts"].size(), 1u);
  EXPECT_EQ(soft["parts"][0]["name"], "lcl");
  EXPECT_FALSE(soft["parts"][0]["whole"]);
  // The hook lifts it and lets it down again.
  const auto ends = events(soft, "soft_end");
  ASSERT_EQ(ends.size(), 3u);
  EXPECT_EQ(ends[0]["hand"], 0);
  EXPECT_NEAR(ends[0]["peak_force_n"], 3.9, 0.1);
  // The blade takes it down strand by strand, at the table's force.
  const auto cuts = events(soft, "soft_strands_cut");
  ASSERT_EQ(cuts.size(), 10u);
  EXPECT_EQ(cuts.back()["hand"], 1);
  EXPECT_LT(cuts.back()["left_percent"], 10);
  EXPECT_NEAR(cuts.back()["force_n"], 8, 0.05);
  EXPECT_TRUE(events(soft, "soft_cut").empty());
  // What is left tears on the hook.
  const auto torn = events(soft, "soft_torn");
  ASSERT_EQ(torn.size(), 1u);
  EXPECT_EQ(torn[0]["hand"], 0);
  EXPECT_EQ(torn[0]["part"], "lcl");
  const Ran again = run_osteon("replay " + file("run.osr"));
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_NE(again.output.find("identical"), std::string::npos);
}

}  // namespace
}  // namespace osteon::testing_cli
