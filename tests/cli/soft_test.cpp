// Ligaments felt in osteon simulate, and again in osteon replay, through the command line alone.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "osteon/scene/build_case.h"
#include "osteon/scene/case_io.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

TriMesh block_of(const Vec3& middle, const Vec3& half) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(middle + Vec3((i & 1) ? half.x() : -half.x(),
                                          (i & 2) ? half.y() : -half.y(),
                                          (i & 4) ? half.z() : -half.z()));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

class SoftSession : public CliTest {
 protected:
  // Two blocks with a ligament of 30 mm between them, and a probe that presses its middle.
  void SetUp() override {
    CliTest::SetUp();
    CaseDef def;
    def.name = "band";
    for (const double x : {-0.025, 0.025}) {
      BoneDef bone;
      bone.name = x < 0 ? "femur" : "tibia";
      bone.mesh = block_of(Vec3(x, 0, 0), Vec3(0.01, 0.01, 0.01));
      def.bones.push_back(bone);
    }
    SoftDef acl;
    acl.name = "acl";
    acl.tissue = acl.kind = "ligament";
    acl.mesh_W = block_of(Vec3::Zero(), Vec3(0.015, 0.003, 0.003));
    acl.bones = {"femur", "tibia"};
    acl.attachments = {{"a", "femur", Vec3(-0.015, 0, 0)}, {"b", "tibia", Vec3(0.015, 0, 0)}};
    def.softs.push_back(acl);
    ASSERT_TRUE(save_case(def, file("whole")));
    def.findings.push_back({"acl_tear", "midsubstance", "torn through"});
    ASSERT_TRUE(save_case(def, file("torn")));
    std::ofstream(file("press.csv")) << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button\n"
                                        "0,2,0,15,1,0,0,0,0\n0.5,2,0,0,1,0,0,0,0\n"
                                        "0.8,2,0,0,1,0,0,0,0\n1.2,2,0,15,1,0,0,0,0\n";
  }
  Ran press(const std::string& name, const std::string& more) const {
    return run_osteon("simulate --case " + file(name) + " --path " + file("press.csv") + " " +
                      more);
  }
  nlohmann::json report() const {
    return nlohmann::json::parse(std::ifstream(file("report.json")), nullptr, false);
  }
};

TEST_F(SoftSession, AnAclIsFeltAndItsRecordingReplays) {
  const Ran ran = press(
      "whole", "--soft ligaments --record " + file("run.osr") + " --report " + file("report.json"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const nlohmann::json soft = report()["soft"];
  ASSERT_EQ(soft["parts"].size(), 1u);
  const nlohmann::json part = soft["parts"][0];
  EXPECT_EQ(part["name"], "acl");
  EXPECT_TRUE(part["whole"]);
  EXPECT_GT(part["peak_force_n"], 1);
  EXPECT_GT(part["peak_tension_n"], part["first_tension_n"]);
  EXPECT_GT(part["contact_s"], 0.2);
  ASSERT_GE(soft["events"].size(), 2u);
  EXPECT_EQ(soft["events"].front()["kind"], "soft_begin");
  EXPECT_EQ(soft["events"].back()["kind"], "soft_end");
  EXPECT_EQ(soft["events"].back()["part"], "acl");
  const Ran again = run_osteon("replay " + file("run.osr"));
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_NE(again.output.find("identical"), std::string::npos);
}

// The jaws shut about it, draw it 4 mm up, and open; then again, until it is pulled off.
TEST_F(SoftSession, AGrasperOfAPathHoldsItAndItIsPulledOff) {
  std::ofstream(file("press.csv"))
      << "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,button,instrument,size,power,jaw\n"
         "0,0,0,20,1,0,0,0,0,grasper,0,0,1\n0.5,0,0,-4,1,0,0,0,0,grasper,0,0,1\n"
         "0.6,0,0,-4,1,0,0,0,0,grasper,0,0,0\n0.8,0,0,0,1,0,0,0,0,grasper,0,0,0\n"
         "0.9,0,0,-4,1,0,0,0,0,grasper,0,0,1\n1,0,0,-4,1,0,0,0,0,grasper,0,0,0\n"
         "1.6,0,0,30,1,0,0,0,0,grasper,0,0,0\n";
  const Ran ran = press("whole", "--soft acl --hand-stiffness 2000 --record " + file("run.osr") +
                                     " --report " + file("report.json"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const nlohmann::json soft = report()["soft"];
  std::map<std::string, nlohmann::json> events;
  for (const nlohmann::json& event : soft["events"]) events[event["kind"]] = event;
  for (const char* kind : {"soft_held", "soft_freed", "soft_slipped"}) {
    ASSERT_TRUE(events.contains(kind)) << kind;
    EXPECT_EQ(events[kind]["part"], "acl");
  }
  EXPECT_GT(events["soft_freed"]["peak_force_n"], 1);
  EXPECT_NEAR(events["soft_slipped"]["force_n"], 10, 0.5);
  EXPECT_TRUE(soft["parts"][0]["whole"]);
  EXPECT_NE(ran.output.find("holds acl"), std::string::npos) << ran.output;
  const Ran again = run_osteon("replay " + file("run.osr"));
  EXPECT_EQ(again.exit_code, 0) << again.output;
}

TEST_F(SoftSession, TheHookTestTellsATornOne) {
  const Ran ran = press("torn", "--soft acl --report " + file("report.json"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const nlohmann::json part = report()["soft"]["parts"][0];
  EXPECT_FALSE(part["whole"]);
  EXPECT_EQ(part["peak_force_n"], 0);
}

TEST_F(SoftSession, NothingIsSoftUnlessAskedFor) {
  const Ran ran = press("whole", "--report " + file("report.json"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_TRUE(report().contains("ticks"));
  EXPECT_FALSE(report().contains("soft"));
}

TEST_F(SoftSession, ALigamentThatTheCaseLacksExitsWithTwoAndSaysWhatThereIs) {
  const Ran ran = press("whole", "--soft pcl");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.output.find("no ligament 'pcl'"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("Choose from acl"), std::string::npos) << ran.output;
  const Ran live = run_osteon("live --case " + file("whole") + " --seconds 0.1 --soft meniscus");
  EXPECT_EQ(live.exit_code, 2) << live.output;
}

}  // namespace
}  // namespace osteon::testing_cli
