#include "runs/reports/portal_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace osteon {
namespace {

Case portal_marks() {
  Case out;
  out.landmarks = {{"portal_al", {0, -0.015, 0}, -Vec3::UnitZ()},
                   {"portal_am", {0, 0.015, 0}, -Vec3::UnitZ()}};
  return out;
}

std::vector<MadePortalFound> both() {
  return {{0, Vec3(0.0005, -0.002, 0.003), Vec3(0.8, 0.6, 0), false, false},
          {1, Vec3(0, 0.001, 0), Vec3(1, 0, 0), false, true}};
}

nlohmann::ordered_json full_report() {
  nlohmann::ordered_json report;
  add_portals(both(), portal_marks(), "builtin:knee:3:left#flexion=80", report);
  return report;
}

TEST(PortalReports, WithoutPortalsThereIsNothingToSay) {
  nlohmann::ordered_json report;
  report["acl"] = nullptr;
  add_portals({}, portal_marks(), "builtin:knee", report);
  EXPECT_FALSE(report.contains("portals"));
  EXPECT_TRUE(report["acl"].is_null());
  EXPECT_EQ(portals_text({}, portal_marks()), "");
}

TEST(PortalReports, OfAnotherReportItIsSaidWhatIsMissing) {
  for (const char* bad : {"", "3", "{}", "{\"portals\": 3}", "{\"portals\": {}}",
                          "{\"portals\": {\"patient\": \"builtin:knee\"}}"}) {
    const auto read = read_portals(bad, "report.json");
    ASSERT_FALSE(read) << bad;
    EXPECT_NE(read.error().message().find("report.json"), std::string::npos);
  }
  auto one = full_report();
  one["portals"].erase("portal_am");
  EXPECT_NE(read_portals(one.dump(), "r").error().message().find("portal_am"), std::string::npos);
  const auto spoiled = [](const char* part, const char* key, double value) {
    auto json = full_report();
    json["portals"]["portal_al"][part][key] = value;
    return read_portals(json.dump(), "r").has_value();
  };
  EXPECT_TRUE(spoiled("off", "up_mm", 4));
  EXPECT_FALSE(spoiled("off", "up_mm", 400));
  EXPECT_FALSE(spoiled("shaft", "in", 0.1));
  EXPECT_FALSE(spoiled("shaft", "in", -0.8));
}

TEST(PortalReports, WhatIsWrittenIsRead) {
  const auto report = full_report();
  EXPECT_NEAR(report["portals"]["portal_al"]["off"]["up_mm"].get<double>(), -2, 1e-9);
  EXPECT_TRUE(report["portals"]["portal_am"]["seen"]);
  const auto read = read_portals(report.dump(), "r");
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->patient, "builtin:knee:3:left");
  for (const MadePortalFound& made : both()) {
    const auto& again = read->portals.at(made.landmark == 0 ? "portal_al" : "portal_am");
    EXPECT_LT((again.off_F - made.off_F).norm(), 1e-12);
    EXPECT_LT((again.shaft_F - made.shaft_F).norm(), 1e-9);
  }
  nlohmann::ordered_json acl;
  acl["acl"]["femur"] = nullptr;
  add_portals({}, portal_marks(), "builtin:knee", acl);
  EXPECT_NEAR(acl["acl"]["portals"]["portal_al"]["p_mm"][1].get<double>(), -15, 1e-9);
  EXPECT_EQ(acl["acl"]["portals"]["portal_al"]["inwards"][2], -1);
}

TEST(PortalReports, PortalsThatWereMadeAreBesideTheirLandmarks) {
  Case knee = portal_marks();
  knee.landmarks.push_back({"tibial_tubercle", {0.04, 0, -0.01}});
  const auto json = portals_json(knee, both());
  const auto mm = json["portal_al"]["p_mm"].get<std::vector<double>>();
  const auto frame = portal_frame(knee, 0);
  ASSERT_TRUE(frame);
  const Vec3 off = 1e-3 * Vec3(mm[0], mm[1], mm[2]) - knee.landmarks[0].p_W;
  EXPECT_NEAR(off.dot(frame->in_W), 0.0005, 1e-12);
  EXPECT_NEAR(off.dot(frame->up_W), -0.002, 1e-12);
  EXPECT_NEAR(off.dot(frame->middle_W), 0.003, 1e-12);
  EXPECT_NEAR(json["portal_al"]["inwards"][2].get<double>(), -0.8, 1e-12);
}

TEST(PortalReports, APatientIsTheSameWhateverIsTornOrBent) {
  EXPECT_EQ(patient_of("builtin:knee:1:left:acl_tear=midsubstance#femur=field,flexion=120"),
            "builtin:knee:1:left");
  EXPECT_EQ(patient_of("builtin:knee"), "builtin:knee");
  EXPECT_EQ(patient_of("some/knee=left#flexion=80"), "some/knee=left");
}

}  // namespace
}  // namespace osteon
