#include "osteon/tissue/solve_scene.h"

#include <gtest/gtest.h>

#include <string>

#include "osteon/base/random.h"

namespace osteon {
namespace {

const std::string kSound = R"(gravity_m_per_s2 = [0, 0, -9.81]
[mesh]
grid = {cells = [10, 2, 3], cell_mm = 4, origin_mm = [1, 2, 3]}
[material]
model = "neo_hookean"
young_kpa = 3
poisson = 0.45
density_kg_per_m3 = 1000
damping_per_s = 5
[[fixed]]
box_mm = [[1, 2, 3], [1, 10, 15]]
axes = "xz"
[[moved]]
box_mm = [[41, 2, 3], [41, 10, 15]]
by_mm = [1, 0, 0]
over_s = 0.5
[[load]]
box_mm = [[5, 2, 3], [5, 10, 15]]
force_n = [0, 0, 0.1]
[run]
time_s = 2
probe_mm = [[5, 3, 4]]
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kSound;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string complaint(const std::string& text) {
  const auto scene = parse_solve_scene(text, "scene.toml");
  return scene ? "none" : scene.error().what + " @ " + scene.error().where;
}

TEST(SolveSceneFile, SaysWhatItMeans) {
  const auto scene = parse_solve_scene(kSound, "scene.toml");
  ASSERT_TRUE(scene) << scene.error().message();
  ASSERT_TRUE(scene->body.grid);
  EXPECT_EQ(scene->body.grid->cells, (std::array<std::uint32_t, 3>{10, 2, 3}));
  EXPECT_DOUBLE_EQ(scene->body.grid->cell_m, 0.004);
  EXPECT_DOUBLE_EQ(scene->body.grid->origin_W.y(), 0.002);
  EXPECT_DOUBLE_EQ(scene->material.young_pa, 3000);
  EXPECT_DOUBLE_EQ(scene->material.damping_per_s, 5);
  EXPECT_EQ(scene->fixed.at(0).axes, (HeldAxes{true, false, true}));
  EXPECT_EQ(scene->moved.at(0).axes, (HeldAxes{true, true, true}));
  EXPECT_DOUBLE_EQ(scene->moved.at(0).by_m.x(), 0.001);
  EXPECT_DOUBLE_EQ(scene->moved.at(0).over_s, 0.5);
  EXPECT_DOUBLE_EQ(scene->loads.at(0).over_s, 1);  // half of the time
  EXPECT_DOUBLE_EQ(scene->gravity_m_per_s2.z(), -9.81);
  EXPECT_DOUBLE_EQ(scene->probes_m.at(0).z(), 0.004);
}

TEST(SolveSceneFile, NamesTheKeyAndTheLine) {
  const auto names = [](const std::string& from, const std::string& to, const std::string& key) {
    const std::string text = complaint(with(from, to));
    EXPECT_NE(text.find("'" + key + "'"), std::string::npos) << to << ": " << text;
    EXPECT_NE(text.find("scene.toml, line "), std::string::npos) << text;
  };
  names("cells = [10, 2, 3]", "cells = [0, 2, 3]", "mesh.grid.cells");
  names("cells = [10, 2, 3]", "cells = [10, 2.5, 3]", "mesh.grid.cells");
  names("cells = [10, 2, 3]", "cells = [1000, 1000, 1000]", "mesh.grid.cells");
  names("cells = [10, 2, 3]", "cells = [10, 2]", "mesh.grid.cells");
  names("cell_mm = 4", "cell_mm = -4", "mesh.grid.cell_mm");
  names("cell_mm = 4", "cell_mm = nan", "mesh.grid.cell_mm");
  names("cell_mm = 4, ", "", "mesh.grid.cell_mm");
  names("origin_mm = [1, 2, 3]", "origin_mm = [1, inf, 3]", "mesh.grid.origin_mm");
  names("\"neo_hookean\"", "\"jelly\"", "material.model");
  names("\"neo_hookean\"", "\"rod\"", "material.model");
  names("young_kpa = 3", "young_kpa = -3", "material.young_kpa");
  names("young_kpa = 3", "young_kpa = \"3\"", "material.young_kpa");
  names("poisson = 0.45", "poisson = 0.5", "material.poisson");
  names("poisson = 0.45", "poisson = nan", "material.poisson");
  names("density_kg_per_m3 = 1000\n", "", "material.density_kg_per_m3");
  names("damping_per_s = 5", "damping_per_s = -5", "material.damping_per_s");
  names("damping_per_s = 5", "dampening = 5", "material.dampening");
  const auto with_prony = [](const std::string& terms) {
    return "damping_per_s = 5\nprony = " + terms;
  };
  names("damping_per_s = 5", with_prony("0.3"), "material.prony");
  names("damping_per_s = 5", with_prony("[{g = -0.3, tau_s = 0.1}]"), "material.prony[0].g");
  names("damping_per_s = 5", with_prony("[{g = 0.3, tau_s = 0}]"), "material.prony[0].tau_s");
  names("damping_per_s = 5", with_prony("[{g = 0.3}]"), "material.prony[0].tau_s");
  names("damping_per_s = 5", with_prony("[{g = nan, tau_s = 1}]"), "material.prony[0].g");
  names("damping_per_s = 5", with_prony("[{g = 0.6, tau_s = 1}, {g = 0.4, tau_s = 2}]"),
        "material.prony");
  names("\"neo_hookean\"", "\"linear\"\nprony = [{g = 0.3, tau_s = 1}]", "material.prony");
  names("time_s = 2", "time_s = 2\nstep_s = 0.1", "run.step_s");
  names("[[1, 2, 3], [1, 10, 15]]", "[[1, 2, 3]]", "fixed[0].box_mm");
  names("axes = \"xz\"", "axes = \"xw\"", "fixed[0].axes");
  names("axes = \"xz\"", "axes = \"xx\"", "fixed[0].axes");
  names("by_mm = [1, 0, 0]", "by_mm = [1, 0]", "moved[0].by_mm");
  names("over_s = 0.5", "over_s = -0.5", "moved[0].over_s");
  names("force_n = [0, 0, 0.1]", "force_n = [0, 0, nan]", "load[0].force_n");
  names("time_s = 2", "time_s = 0", "run.time_s");
  names("probe_mm = [[5, 3, 4]]", "probe_mm = [5, 3, 4]", "run.probe_mm");
  names("gravity_m_per_s2 = [0, 0, -9.81]", "gravity_m_per_s2 = \"down\"", "gravity_m_per_s2");
  names("gravity_m_per_s2", "weight", "weight");
}

const std::string kRod = R"([mesh]
rod = {points_mm = [[0, 0, 0], [100, 0, 0]], radius_mm = 1, segments = 20, straight_at_rest = true}
[material]
model = "rod"
young_kpa = 3
poisson = 0.45
density_kg_per_m3 = 1000
friction = 0.2
[[fixed]]
box_mm = [[-1, -1, -1], [1, 1, 1]]
clamp = true
[[moved]]
box_mm = [[99, -1, -1], [101, 1, 1]]
turn_deg = [180, 0, 0]
[[obstacle]]
cylinder = {from_mm = [50, -20, -10], to_mm = [50, 20, -10], radius_mm = 5}
friction = 0.4
[[obstacle]]
sphere = {center_mm = [20, 0, -10], radius_mm = 4}
[run]
time_s = 2
)";

TEST(SolveSceneFile, SaysWhatARodMeans) {
  const auto scene = parse_solve_scene(kRod, "rod.toml");
  ASSERT_TRUE(scene) << scene.error().message();
  ASSERT_TRUE(scene->body.rod);
  EXPECT_TRUE(scene->body.rod->straight_at_rest);
  EXPECT_EQ(scene->body.rod->segments, 20);
  EXPECT_DOUBLE_EQ(scene->friction, 0.2);
  EXPECT_EQ(scene->fixed.at(0).clamp, std::optional(true));
  EXPECT_FALSE(scene->moved.at(0).clamp);
  EXPECT_NEAR(scene->moved.at(0).turn_rad.x(), 3.14159265, 1e-8);
  EXPECT_TRUE(scene->moved.at(0).by_m.isZero());
  ASSERT_EQ(scene->obstacles.size(), 2u);
  EXPECT_DOUBLE_EQ(scene->obstacles[0].friction, 0.4);
  EXPECT_DOUBLE_EQ(scene->obstacles[1].radius_m, 0.004);
  EXPECT_EQ(scene->obstacles[1].from_W, scene->obstacles[1].to_W);
}

TEST(SolveSceneFile, NamesTheKeyOfARod) {
  const auto names = [](const std::string& from, const std::string& to, const std::string& key) {
    std::string text = kRod;
    text.replace(text.find(from), from.size(), to);
    EXPECT_NE(complaint(text).find("'" + key + "'"), std::string::npos) << complaint(text);
  };
  names("straight_at_rest = true", "straight_at_rest = 1", "mesh.rod.straight_at_rest");
  names("radius_mm = 1", "radius_mm = 0", "mesh.rod.radius_mm");
  names("segments = 20", "segments = 0", "mesh.rod.segments");
  names("friction = 0.2", "friction = -1", "material.friction");
  names("clamp = true", "clamp = \"yes\"", "fixed[0].clamp");
  names("turn_deg = [180, 0, 0]", "turn_deg = 180", "moved[0].turn_deg");
  names("turn_deg = [180, 0, 0]", "over_s = 1", "moved[0].by_mm");
  names("radius_mm = 5", "radius_mm = nan", "obstacle[0].cylinder.radius_mm");
  names("sphere = ", "cube = ", "obstacle[1].cube");
  EXPECT_NE(complaint(with("damping_per_s = 5", "friction = 1")).find("'material.friction'"),
            std::string::npos);
}

TEST(SolveSceneFile, RefusesWhatIsMissingOrTwo) {
  EXPECT_NE(complaint("").find("'mesh'"), std::string::npos);
  EXPECT_NE(complaint("[mesh]\nvtk = \"a\"\ngrid = 1\n").find("'mesh."), std::string::npos);
  EXPECT_NE(complaint("[mesh\n").find("line 1"), std::string::npos);
}

TEST(SolveSceneFile, AMeshThatIsNotThereIsNamed) {
  const auto scene = load_solve_scene("/nowhere/scene.toml");
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message().find("/nowhere/scene.toml"), std::string::npos);
}

// Bytes changed at random: an error or a scene that can be solved, never a crash.
TEST(SolveSceneFile, SurvivesDamage) {
  Random random(17);
  int read = 0;
  for (int n = 0; n < 3000; ++n) {
    std::string text = kSound;
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(text.size()));
      const auto byte = static_cast<char>(random.next() % 128);
      text[at] = byte;
    }
    const auto scene = parse_solve_scene(text, "damaged");
    if (!scene) continue;
    ++read;
    EXPECT_TRUE(check_material(scene->material));
    EXPECT_TRUE(is_finite(scene->gravity_m_per_s2));
  }
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace osteon
