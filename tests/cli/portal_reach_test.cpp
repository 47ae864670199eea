// What a probe reaches through a portal of the built-in wrist, as a surgeon leads it.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

// Straight from 11.5 mm before portal 4-5, over the portal, to 2 mm under the surface of the lunate
// where it faces the triquetrum, a second there, and back; the shaft lies along the way. Other bone
// leaves the way free.
constexpr const char* kOnTheLunate =
    "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n"
    "0,-17.4139,-1.6794,20.6169,0.954614,-0.206393,-0.214742,0,0,wrist_hook_probe,0,0,0\n"
    "2,-7.2500,-11.4481,0.2248,0.954614,-0.206393,-0.214742,0,0,wrist_hook_probe,0,0,0\n"
    "3,-7.2500,-11.4481,0.2248,0.954614,-0.206393,-0.214742,0,0,wrist_hook_probe,0,0,0\n"
    "4.5,-17.4139,-1.6794,20.6169,0.954614,-0.206393,-0.214742,0,0,wrist_hook_probe,0,0,0\n";

TEST_F(CliTest, AProbeThroughPortalFourFiveTouchesTheLunate) {
  std::ofstream(file("p.csv")) << kOnTheLunate;
  const Ran ran =
      run_osteon("simulate --case builtin:wrist --structures --hand right=" + file("p.csv") +
                 " --record " + file("r.osr"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const Ran told = run_osteon("record info " + file("r.osr") + " --events --json");
  ASSERT_EQ(told.exit_code, 0) << told.output;
  std::string order;
  std::istringstream lines(told.output);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('{')) continue;
    const nlohmann::json event = nlohmann::json::parse(line);
    const std::string kind = event["kind"], subject = event.value("subject", "");
    if (kind == "contact_end" && subject == "lunate") {
      EXPECT_GT(event["duration_s"].get<double>(), 0.9);
    }
    if (subject == "lunate" || subject == "portal_4_5" || subject == "skin")
      order += kind + " " + subject + "\n";
  }
  EXPECT_TRUE(order.starts_with("structure_entered skin\nportal_entered portal_4_5\n") ||
              order.starts_with("portal_entered portal_4_5\nstructure_entered skin\n"))
      << told.output;
  EXPECT_NE(order.find("contact_begin lunate\ncontact_end lunate\n"), std::string::npos) << order;
  EXPECT_NE(order.find("portal_left portal_4_5\n"), std::string::npos) << order;
  EXPECT_NE(order.find("structure_left skin\n"), std::string::npos) << order;
}

}  // namespace
}  // namespace osteon::testing_cli
