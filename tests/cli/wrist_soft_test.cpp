// Ligaments and the disc of a wrist felt through the command line alone, whole and torn.
#include <fstream>
#include <nlohmann/json.hpp>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

class WristSoft : public CliTest {
 protected:
  static void SetUpTestSuite() {
    made_ = fs::temp_directory_path() / ("osteon_wrist_soft_" + std::to_string(::getpid()));
    fs::create_directories(made_);
    make("whole", "");
    make("torn", "--finding tfcc_tear=1B --finding geissler=4");
  }
  static void TearDownTestSuite() { fs::remove_all(made_); }
  static void make(const std::string& name, const std::string& findings) {
    const Ran ran =
        run_osteon("anatomy make wrist " + findings + " --out " + (made_ / name).string());
    ASSERT_EQ(ran.exit_code, 0) << ran.output;
  }
  static std::string path(const std::string& name) {
    return OSTEON_SOURCE_DIR "/assets/paths/" + name + ".csv";
  }
  // What of the case's bones is felt does not matter: their hulls are soon made.
  Ran simulate(const std::string& name, const std::string& with, const std::string& more) const {
    return run_osteon("simulate --case '" + (made_ / name).string() + "#hull' --path " +
                      path(with) + " --report " + file("report.json") + " " + more);
  }
  nlohmann::json part(const std::string& name) const {
    const auto report = nlohmann::json::parse(std::ifstream(file("report.json")), nullptr, false);
    for (const nlohmann::json& one : report["soft"]["parts"])
      if (one["name"] == name) return one;
    return {};
  }
  double stiffness(const std::string& name, const std::string& with) const {
    const Ran ran = simulate(name, with, "--soft tfcc");
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    const nlohmann::json disc = part("tfcc_disc");
    EXPECT_GT(disc["contact_s"], 1) << ran.output;
    return 1e3 * disc["peak_force_n"].get<double>() / disc["deepest_mm"].get<double>();
  }

  static inline fs::path made_;
};

// The bounds: a torn disc that were as stiff as a whole one has a ratio of 1.
TEST_F(WristSoft, APressAndAHookTellATornDisc) {
  const double pressed = stiffness("whole", "wrist_tfcc_press");
  EXPECT_NEAR(pressed / 900, 1, 0.25);  // of the tissue table's meniscus
  EXPECT_LT(stiffness("torn", "wrist_tfcc_press"), 0.75 * pressed);
  EXPECT_LT(stiffness("torn", "wrist_tfcc_hook"), 0.5 * stiffness("whole", "wrist_tfcc_hook"));
}

TEST_F(WristSoft, AHookPullsTheScapholunateLigamentUnlessItIsTorn) {
  const std::string record = "--record " + file("run.osr") + " --soft ligaments";
  Ran ran = simulate("whole", "wrist_scapholunate_hook", record);
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const nlohmann::json dorsal = part("scapholunate_dorsal");
  EXPECT_TRUE(dorsal["whole"]);
  EXPECT_GT(dorsal["peak_force_n"], 0.5);
  EXPECT_GT(dorsal["peak_tension_n"], dorsal["first_tension_n"]);
  for (const char* name : {"lunotriquetral_volar", "radioscaphocapitate", "ulnotriquetral",
                           "dorsal_radiocarpal", "dorsal_intercarpal"})
    EXPECT_FALSE(part(name).is_null()) << name;
  const Ran again = run_osteon("replay " + file("run.osr"));
  EXPECT_EQ(again.exit_code, 0) << again.output;
  EXPECT_NE(again.output.find("identical"), std::string::npos);
  ran = simulate("torn", "wrist_scapholunate_hook", "--soft scapholunate_dorsal");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_FALSE(part("scapholunate_dorsal")["whole"]);
  EXPECT_EQ(part("scapholunate_dorsal")["peak_force_n"], 0);
}

TEST_F(WristSoft, LigamentsOfTheMidcarpalJointAreFeltByName) {
  const Ran ran = simulate("whole", "wrist_scapholunate_hook",
                           "--soft triquetrohamate,triquetrocapitate,scaphocapitate,"
                           "scaphotrapezial,capitohamate_volar,capitohamate_dorsal,"
                           "capitotrapezoid_dorsal,trapeziotrapezoid_dorsal");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  EXPECT_EQ(part("triquetrohamate")["first_tension_n"], 0) << "just not tight";
  EXPECT_GT(part("capitohamate_volar")["first_tension_n"], 1);
  EXPECT_TRUE(part("scaphotrapezial")["whole"]);
}

TEST_F(WristSoft, WhatAWristLacksExitsWithTwoAndSaysWhatThereIs) {
  const Ran ran = simulate("whole", "wrist_tfcc_press", "--soft acl");
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.output.find("Choose from scapholunate_dorsal"), std::string::npos) << ran.output;
}

}  // namespace
}  // namespace osteon::testing_cli
