// osteon tunnel, osteon case measure and osteon drill, as a user runs them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "osteon/base/file.h"
#include "osteon/mesh/measure.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"
#include "run_osteon.h"

namespace osteon::tunnel_commands {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Printed {
  int exit_code = 0;
  std::string out;
};
Printed run(std::initializer_list<std::string> arguments) {
  std::string line;
  for (const std::string& a : arguments) line.append(" '").append(a).append("'");
  const testing_cli::Ran ran = testing_cli::run_osteon(line);
  return {ran.exit_code, ran.output};
}

/// A case in millimetres of one cube of 20 mm, which stands 100 mm along x in World.
fs::path block_in_mm(const std::string& name) {
  const fs::path dir = fs::temp_directory_path() / ("osteon_tunnel_" + name);
  fs::remove_all(dir);
  fs::create_directories(dir);
  TriMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(0.01 * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  EXPECT_TRUE(save_stl(m, dir / "block.stl", 0.001));
  EXPECT_TRUE(write_file_atomic(dir / "case.toml",
                                "format = 1\nname = \"block\"\nmesh_unit = \"mm\"\n\n[[bones]]\n"
                                "name = \"block\"\nmesh = \"block.stl\"\n"
                                "position_m = [0.1, 0, 0]\n"));
  return dir;
}

TEST(TunnelCommand, DrillsABoneInItsCasesUnitAndMeasureFindsTheHole) {
  const fs::path dir = block_in_mm("drills");
  const fs::path out = dir / "drilled.stl";
  const Printed drilled = run({"tunnel", dir.string() + "#block", "--from", "101,2,-30", "--to",
                               "101,2,30", "--diameter", "6", "--out", out.string(), "--json"});
  ASSERT_EQ(drilled.exit_code, 0) << drilled.out;
  const Json json = Json::parse(drilled.out);
  EXPECT_NEAR(json["removed_mm3"].get<double>() / (M_PI * 9 * 20), 1, 1e-3);
  EXPECT_NEAR(json["length_mm"].get<double>(), 20, 1e-6);
  EXPECT_EQ(json["through"], true);
  auto mesh = load_mesh(out, 0.001);
  ASSERT_TRUE(mesh);
  weld_vertices(*mesh, 0);
  EXPECT_TRUE(topology(*mesh).closed());
  EXPECT_NEAR(1e9 * volume(*mesh), 8000 - json["removed_mm3"].get<double>(), 0.01);

  fs::copy_file(out, dir / "block.stl", fs::copy_options::overwrite_existing);
  const Printed measure = run({"case", "measure", dir.string(), "--json"});
  ASSERT_EQ(measure.exit_code, 0) << measure.out;
  const Json holes = Json::parse(measure.out)["holes"];
  ASSERT_EQ(holes.size(), 1u);
  EXPECT_NEAR(holes[0]["diameter_mm"].get<double>(), 6, 0.005);
  EXPECT_NEAR(holes[0]["length_mm"].get<double>(), 20, 0.01);
  EXPECT_NEAR(holes[0]["entry_mm"][0].get<double>(), 101, 0.01);
  EXPECT_NEAR(holes[0]["thinnest_wall_mm"].get<double>(), 5, 0.05);
}

TEST(TunnelCommand, AMissSaysSoAndBadInputWritesNothing) {
  const fs::path dir = block_in_mm("miss");
  const fs::path out = dir / "drilled.stl";
  const auto drill = [&](const std::string& bone, const std::string& from,
                         const std::string& size) {
    return run({"tunnel", dir.string() + bone, "--from", from, "--to", "300,0,0", "--diameter",
                size, "--out", out.string(), "--json"});
  };
  EXPECT_EQ(drill("#none", "0,0,0", "6").exit_code, 2);
  EXPECT_EQ(drill("", "0,0,0", "6").exit_code, 2);
  EXPECT_EQ(drill("#block", "0,0,nan", "6").exit_code, 2);
  EXPECT_EQ(drill("#block", "0,0,0", "-6").exit_code, 2);
  EXPECT_EQ(drill("#block", "0,0,0", "90").exit_code, 2);  // removes the whole bone
  EXPECT_FALSE(fs::exists(out));
  const Printed missed = drill("#block", "300,0,100", "6");
  EXPECT_EQ(missed.exit_code, 1);
  EXPECT_EQ(Json::parse(missed.out)["removed_mm3"], 0);
  const Printed blind =
      run({"tunnel", dir.string() + "#block", "--from", "0,0,0", "--to", "300,0,0", "--diameter",
           "6", "--depth", "7", "--out", out.string(), "--json"});
  EXPECT_EQ(blind.exit_code, 0);
  EXPECT_EQ(Json::parse(blind.out)["through"], false);
  EXPECT_NEAR(Json::parse(blind.out)["length_mm"].get<double>(), 7, 1e-6);
}

TEST(DrillCommand, TrialAndResistanceTellTheirFigures) {
  const Printed trial =
      run({"drill", "trial", "--thrust-n", "60", "--layer", "cortical_bone=1", "--json"});
  ASSERT_EQ(trial.exit_code, 0) << trial.out;
  EXPECT_EQ(Json::parse(trial.out)["through"], true);
  EXPECT_EQ(run({"drill", "trial", "--layer", "cheese=1"}).exit_code, 2);
  const fs::path svg = block_in_mm("svg") / "force.svg";
  const Printed drawn = run({"drill", "resistance", "--out", svg.string()});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.out;
  EXPECT_NE(drawn.out.find("radial functions 0"), std::string::npos) << drawn.out;
}

}  // namespace
}  // namespace osteon::tunnel_commands
