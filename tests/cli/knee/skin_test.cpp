// Skin of the built-in knee, cut by a scalpel and pierced by a trocar, through the command line.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "../run_osteon.h"

namespace osteon::testing_cli {
namespace {

class SkinSession : public CliTest {
 protected:
  Ran work(const std::string& soft, const std::string& more) const {
    return run_osteon("simulate --case builtin:knee --hand right=" OSTEON_SOURCE_DIR
                      "/assets/paths/knee_incision.csv --portals none --max-force 40 "
                      "--hand-stiffness 3000 --soft " +
                      soft + " " + more);
  }
};

TEST_F(SkinSession, IsCutAndPiercedAtThePortalAndItsRecordingReplays) {
  const Ran ran =
      work("skin:portal_al", "--record " + file("run.osr") + " --report " + file("report.json"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto report = nlohmann::json::parse(std::ifstream(file("report.json")), nullptr, false);
  const nlohmann::json soft = report["soft"];
  ASSERT_EQ(soft["parts"].size(), 1u);
  const nlohmann::json part = soft["parts"][0];
  EXPECT_EQ(part["name"], "skin:portal_al");
  EXPECT_FALSE(part["whole"]);
  EXPECT_EQ(part["holes"], 1);
  // The table's 25 N on a trocar of 5 mm, on one of 5.5 mm.
  EXPECT_NEAR(part["peak_force_n"], 25 * 1.1 * 1.1, 0.5);
  std::map<std::string, nlohmann::json> events;
  for (const nlohmann::json& event : soft["events"]) events.emplace(event["kind"], event);
  for (const char* kind : {"soft_begin", "soft_end", "skin_cut", "skin_cut_end", "skin_entered",
                           "skin_pierced", "skin_left"}) {
    ASSERT_TRUE(events.contains(kind)) << kind;
    EXPECT_EQ(events[kind]["part"], "skin");
  }
  // Through the cut and beside it the trocar makes a portal each.
  ASSERT_EQ(part["portals"], 2);
  ASSERT_TRUE(events.contains("portal_made"));
  EXPECT_EQ(events["portal_made"]["portal"], "portal_al_made_1");
  EXPECT_EQ(events["portal_made"]["pierced"], 0);
  EXPECT_LT(events["portal_made"]["off_mm"], 6);
  const nlohmann::json portals = report["hands"]["right"]["portals"];
  EXPECT_TRUE(portals.contains("portal_al_made_2")) << portals;
  EXPECT_FALSE(portals.contains("portal_al_made_3")) << portals;
  // The path draws the blade 12 mm far.
  EXPECT_NEAR(events["skin_cut_end"]["length_mm"], 12, 1.2);
  EXPECT_NEAR(events["skin_cut"]["force_n"], 1, 0.01);
  EXPECT_NEAR(events["skin_pierced"]["force_n"], 25 * 1.1 * 1.1, 0.5);
  const Ran again = run_osteon("replay " + file("run.osr"));
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_NE(again.output.find("identical"), std::string::npos);
}

TEST_F(SkinSession, APlaceThatTheCaseLacksIsNamed) {
  const Ran ran = work("skin:elbow", "");
  EXPECT_EQ(ran.exit_code, 2) << ran.output;
  EXPECT_NE(ran.output.find("elbow"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("skin:portal_al"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace osteon::testing_cli
