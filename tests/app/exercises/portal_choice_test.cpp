#include "exercises/portal_choice.h"

#include <gtest/gtest.h>

#include "cases/open_case.h"
#include "osteon/procedure/judge.h"
#include "osteon/scene/portal.h"

namespace osteon {
namespace {

ReportedPortals portals_of(const std::string& patient) {
  ReportedPortals made{patient, {}};
  made.portals["portal_al"] = {0, Vec3(0.001, -0.004, 0.003), Vec3(0.8, 0.6, 0), false, false};
  made.portals["portal_am"] = {1, Vec3::Zero(), Vec3::UnitX(), false, true};
  return made;
}

TEST(PortalChoice, AnotherPatientOrSideIsRefused) {
  const std::string spec = "builtin:knee:1:left:acl_tear=midsubstance#flexion=120";
  for (const char* other : {"builtin:knee:1:right", "builtin:knee:2:left", "builtin:knee", ""}) {
    const auto chosen = with_made_portals(spec, portals_of(other), "report.json");
    ASSERT_FALSE(chosen) << other;
    EXPECT_NE(chosen.error().message().find("report.json"), std::string::npos);
    EXPECT_NE(chosen.error().message().find("builtin:knee:1:left"), std::string::npos);
  }
  EXPECT_FALSE(with_made_portals("builtin:wrist", portals_of("builtin:wrist"), "report.json"));
}

TEST(PortalChoice, PortalsLieBesideTheirLandmarksAsTheyWereMade) {
  const std::string spec = "builtin:knee:1:left:acl_tear=midsubstance#hull,flexion=120";
  const auto chosen = with_made_portals(spec, portals_of("builtin:knee:1:left"), "r");
  ASSERT_TRUE(chosen) << chosen.error().message();
  const auto before = open_case(spec, {}, CaseParts::kAll);
  const auto after = open_case(*chosen, {}, CaseParts::kAll);
  ASSERT_TRUE(before && after);
  const auto at = [](const Case& c, const char* name) {
    return c.landmarks[*find_landmark(c, name)].p_W;
  };
  const auto frame = portal_frame(**before, *find_landmark(**before, "portal_al"));
  ASSERT_TRUE(frame);
  const Vec3 off = at(**after, "portal_al") - at(**before, "portal_al");
  EXPECT_NEAR(off.dot(frame->in_W), 0.001, 1e-9);
  EXPECT_NEAR(off.dot(frame->up_W), -0.004, 1e-9);
  EXPECT_NEAR(off.dot(frame->middle_W), 0.003, 1e-9);
  EXPECT_LT((at(**after, "portal_am") - at(**before, "portal_am")).norm(), 1e-9);
  bool found = false;
  for (const Portal& portal : find_portals(**after)) {
    if (portal.name != "portal_al") continue;
    found = true;
    EXPECT_NEAR(portal.nhat_W.dot(frame->in_W), 0.8, 1e-9);
    EXPECT_NEAR(portal.nhat_W.dot(frame->up_W), 0.6, 1e-9);
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace osteon
