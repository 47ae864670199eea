// osteon tissue solve, through the command line alone.
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

class TissueSolve : public CliTest {
 protected:
  static std::string example() { return OSTEON_SOURCE_DIR "/assets/tissue/cantilever.toml"; }

  // The example with one text in place of another.
  std::string changed(const std::string& from, const std::string& to) const {
    std::ostringstream whole;
    whole << std::ifstream(example()).rdbuf();
    std::string text = whole.str();
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    std::ofstream(file("scene.toml")) << text.replace(at, from.size(), to);
    return file("scene.toml");
  }
};

TEST_F(TissueSolve, TellsHowTheExampleBends) {
  const Ran ran = run_osteon("tissue solve " + example() + " --json --out " + file("bent.vtk"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto json = nlohmann::json::parse(ran.output, nullptr, false);
  // Timoshenko: F L^3 / (3 E I) + F L / (k G A) = 2.206 mm.
  EXPECT_NEAR(double(json["probes"][0]["moved_mm"][2]), -2.206, 0.03 * 2.206);
  EXPECT_EQ(json["probes"][0]["at_mm"][0], 120);
  EXPECT_EQ(json["reactions"][0]["of"], "fixed");
  EXPECT_EQ(json["reactions"][0]["index"], 0);
  EXPECT_NEAR(double(json["reactions"][0]["force_n"][2]), 0.005, 1e-5);
  EXPECT_EQ(json["elements"], 384);
  EXPECT_GT(double(json["steps"]) * double(json["step_s"]), 1.499);
  EXPECT_GT(double(json["element_steps_per_s"]), 0);
  EXPECT_GT(double(json["strain_energy_mj"]), 0);
  EXPECT_LT(double(json["hourglass_energy_mj"]), 0.05 * double(json["strain_energy_mj"]));
  EXPECT_GE(double(json["kinetic_energy_mj"]), 0);
  EXPECT_EQ(json["settled"], true);
  std::ifstream vtk(file("bent.vtk"));
  std::string first;
  std::getline(vtk, first);
  EXPECT_EQ(first, "# vtk DataFile Version 3.0");
}

TEST_F(TissueSolve, BadScenesExitWithTwoAndNameTheKey) {
  const std::pair<std::pair<std::string, std::string>, std::string> bad[] = {
      {{"cells = [24, 4, 4]", "cells = [0, 4, 4]"}, "mesh.grid.cells"},
      {{"poisson = 0.3", "poisson = 0.5"}, "material.poisson"},
      {{"young_kpa = 100", "young_kpa = -1"}, "material.young_kpa"},
      {{"force_n = [0, 0, -0.005]", "force_n = [0, 0, nan]"}, "load[0].force_n"},
      {{"[[120, 0, 0]", "[[121, 0, 0]"}, "load[0]"},
      {{"[[120, 10, 10]]", "[[121, 10, 10]]"}, "run.probe_mm[0]"},
      {{"grid = {cells = [24, 4, 4], cell_mm = 5, origin_mm = [0, 0, 0]}", "vtk = \"none.vtk\""},
       "mesh.vtk"}};
  for (const auto& [change, key] : bad) {
    std::string scene = changed(change.first, change.second);
    if (key == "load[0]") {
      std::ostringstream whole;
      whole << std::ifstream(scene).rdbuf();
      std::string text = whole.str();
      text.replace(text.find("[120, 20, 20]"), 13, "[121, 20, 20]");
      std::ofstream(scene) << text;
    }
    const Ran ran = run_osteon("tissue solve " + scene);
    EXPECT_EQ(ran.exit_code, 2) << key << ": " << ran.output;
    EXPECT_NE(ran.output.find(key), std::string::npos) << ran.output;
  }
}

TEST_F(TissueSolve, ALostPartIsNamedAndExitsWithOne) {
  const Ran ran = run_osteon("tissue solve " + changed("-0.005]", "-500]"));
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_NE(ran.output.find("hexahedron"), std::string::npos) << ran.output;
  EXPECT_EQ(ran.output.find("nan"), std::string::npos) << ran.output;
}

TEST_F(TissueSolve, ARopeOverAnEdgePullsByTheCapstan) {
  const std::string rope = OSTEON_SOURCE_DIR "/assets/tissue/rope.toml";
  const Ran ran = run_osteon("tissue solve " + rope + " --json --out " + file("rope.vtk"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto json = nlohmann::json::parse(ran.output, nullptr, false);
  // exp(0.3 pi) times 0.05 N.
  EXPECT_NEAR(double(json["reactions"][0]["force_n"][2]), -0.1283, 0.05 * 0.1283);
  EXPECT_EQ(json["reactions"][0]["of"], "moved");
  EXPECT_EQ(json["reactions"][0]["moment_n_mm"].size(), 3u);
  EXPECT_EQ(json["elements"], 60);
  std::ostringstream whole;
  whole << std::ifstream(file("rope.vtk")).rdbuf();
  EXPECT_NE(whole.str().find("POINTS 734 double"), std::string::npos);
  EXPECT_NE(whole.str().find("VECTORS moved_mm double"), std::string::npos);
}

class TissueSkin : public CliTest {};

TEST_F(TissueSkin, TellsHowTheIncisionOpensAndWhatTheTrocarTakes) {
  const Ran ran =
      run_osteon("tissue skin " OSTEON_SOURCE_DIR "/assets/tissue/incision.toml --json --out " +
                 file("skin.vtk"));
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  const auto json = nlohmann::json::parse(ran.output, nullptr, false);
  EXPECT_NEAR(double(json["cuts"][0]["opened_mm"]), double(json["cuts"][0]["stroke_mm"]), 0.6);
  EXPECT_LT(double(json["cuts"][0]["off_mm"]), 0.3);
  // Of an endless sheet that no fat holds: 4 T a / Eh = 4.9 mm.
  EXPECT_GT(double(json["widest_mm"]), 2);
  EXPECT_LT(double(json["widest_mm"]), 4.9);
  EXPECT_GT(double(json["presses"][0]["dent_mm"]), 1);
  EXPECT_EQ(json["pierces"][0]["pierced"], true);
  EXPECT_NEAR(double(json["pierces"][0]["peak_n"]), 25, 0.3);
  EXPECT_LT(double(json["pierces"][0]["deepest_n"]), 4);
  EXPECT_GT(json["pierces"][0]["curve"].size(), 100u);
  std::ifstream vtk(file("skin.vtk"));
  std::string first;
  std::getline(vtk, first);
  EXPECT_EQ(first, "# vtk DataFile Version 3.0");
}

TEST_F(TissueSkin, BadScenesExitWithTwo) {
  std::ofstream(file("scene.toml")) << "[sheet]\nsize_mm = [60, 0]\n";
  const Ran flat = run_osteon("tissue skin " + file("scene.toml"));
  EXPECT_EQ(flat.exit_code, 2);
  EXPECT_NE(flat.output.find("side of the sheet"), std::string::npos) << flat.output;
  const Ran none = run_osteon("tissue skin " + file("none.toml"));
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.output.find("none.toml"), std::string::npos) << none.output;
}

TEST_F(TissueSkin, LiesOnAKneeWhereTheSceneSays) {
  const auto at = [&](const std::string& landmark) {
    std::ofstream(file("scene.toml")) << "[sheet]\nsize_mm = [20, 20]\n[place]\n"
                                      << "case = \"builtin:knee\"\nat = \"" << landmark
                                      << "\"\n[[cut]]\npoints_mm = [[-4, 0], [4, 0]]\n";
    return run_osteon("tissue skin " + file("scene.toml") + " --json --picture " + file("a.png"));
  };
  const Ran ran = at("portal_am");
  ASSERT_EQ(ran.exit_code, 0) << ran.output;
  // The progress of growing the knee stands before it.
  const auto json = nlohmann::json::parse(ran.output.substr(ran.output.find('{')), nullptr, false);
  EXPECT_NEAR(double(json["place"]["at_mm"][1]), 14, 6);
  EXPECT_GT(double(json["place"]["z"][2]), 0.5);   // out of the front of the knee
  EXPECT_LT(double(json["place"]["y"][0]), -0.5);  // towards the trunk
  EXPECT_TRUE(std::ifstream(file("a.png")).good());
  const Ran none = at("portal_xy");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.output.find("no landmark 'portal_xy'"), std::string::npos) << none.output;
}

}  // namespace
}  // namespace osteon::testing_cli
