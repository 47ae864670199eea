#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/support/commands.h"
#include "commands/support/parser.h"
#include "osteon/hull/hull.h"
#include "osteon/mesh/mesh_io.h"

namespace osteon {
namespace {

struct Ran {
  int exit_code = 0;
  std::string out;
  std::string err;
};

Ran run_hull(std::vector<std::string> arguments) {
  cli::App app("test", "osteon");
  Ran ran;
  add_hull_command(app, ran.exit_code);
  arguments.insert(arguments.begin(), "hull");
  std::reverse(arguments.begin(), arguments.end());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  try {
    app.parser().parse(arguments);
  } catch (const CLI::ParseError&) {
    ran.exit_code = 2;
  }
  ran.out = testing::internal::GetCapturedStdout();
  ran.err = testing::internal::GetCapturedStderr();
  return ran;
}

class HullCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    // A cube of 20 mm with its centre as one more vertex.
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) {
      points.emplace_back(0.02 * (k & 1), 0.02 * ((k >> 1) & 1), 0.02 * ((k >> 2) & 1));
    }
    TriMesh mesh = to_mesh(*build_hull(points).hull);
    mesh.vertices.emplace_back(0.01, 0.01, 0.01);
    mesh.triangles.push_back({0, 1, 8});
    ASSERT_TRUE(save_stl(mesh, cube_, 1e-3));
    ASSERT_TRUE(save_stl({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}},
                         flat_, 1e-3));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("osteon_hull_") + testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string cube_ = folder_ / "cube.stl";
  std::string flat_ = folder_ / "flat.stl";
  std::string out_ = folder_ / "hull.stl";
};

TEST_F(HullCommand, PrintsJson) {
  const Ran ran = run_hull({cube_, "--unit", "mm", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto json = nlohmann::json::parse(ran.out);
  ASSERT_EQ(json.size(), 1u);
  EXPECT_EQ(json[0]["vertices"], 8);
  EXPECT_EQ(json[0]["facets"], 6);
  EXPECT_NEAR(json[0]["volume_m3"], 8e-6, 1e-11);
  EXPECT_EQ(json[0]["mesh"], cube_);
}

TEST_F(HullCommand, WritesTheHullInTheMeshsUnit) {
  ASSERT_EQ(run_hull({cube_, "--unit", "mm", "--out", out_}).exit_code, 0);
  const auto raw = load_mesh(out_, 1.0);
  ASSERT_TRUE(raw);
  Aabb box;
  for (const Vec3& v : raw->vertices) box.include(v);
  EXPECT_TRUE(box.lo.isZero());
  EXPECT_TRUE(box.hi.isApprox(Vec3::Constant(20), 1e-7));
}

TEST_F(HullCommand, PrintsTextForSeveralMeshes) {
  const Ran ran = run_hull({cube_, cube_});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.out.find("8 vertices, 6 facets"), std::string::npos);
}

TEST_F(HullCommand, RefusesOneFileForSeveralHulls) {
  const Ran ran = run_hull({cube_, cube_, "--out", out_});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.err.find("--out"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(HullCommand, NamesWhatIsWrong) {
  const Ran flat = run_hull({flat_, "--unit", "mm"});
  EXPECT_EQ(flat.exit_code, 2);
  EXPECT_NE(flat.err.find("one plane"), std::string::npos) << flat.err;
  EXPECT_NE(flat.err.find(flat_), std::string::npos) << flat.err;
  EXPECT_EQ(run_hull({folder_ / "absent.stl"}).exit_code, 2);
  EXPECT_EQ(run_hull({cube_, "--unit", "inch"}).exit_code, 2);
  EXPECT_EQ(run_hull({}).exit_code, 2);
}

}  // namespace
}  // namespace osteon
