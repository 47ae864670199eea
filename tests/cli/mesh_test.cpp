// Tetrahedra and edited surfaces, through the command line alone.
#include <fstream>
#include <nlohmann/json.hpp>

#include "block_case.h"
#include "run_osteon.h"

namespace osteon::testing_cli {
namespace {

class Mesh : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    ASSERT_EQ(make_block_case(dir_).exit_code, 0);
    block_ = file("meshes/block.obj") + " --unit mm";
  }
  std::string block_;  ///< 40 mm each way, about the origin
};

TEST_F(Mesh, BadInputExitsWithTwoAndSaysWhat) {
  std::ofstream(file("open.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(file("bad.vtk")) << "# vtk DataFile Version 3.0\nx\nBINARY\n";
  const std::pair<std::string, std::string> bad[] = {
      {"tetrahedra " + file("none.stl") + " --unit mm", "none.stl"},
      {"tetrahedra " + file("meshes/block.obj"), "--unit"},
      {"tetrahedra " + file("open.obj") + " --unit mm", "not closed"},
      {"tetrahedra " + file("case"), "#PART"},
      {"tetrahedra " + file("case") + "#femur", "block"},
      {"tetrahedra " + block_ + " --cell-mm 100", "thinner than a cell"},
      {"tetrahedra " + block_ + " --cell-mm 0.01", "larger cell"},
      {"tetrahedra " + block_ + " --cell-mm 2 --most 500", "500 tetrahedra"},
      {"quality " + file("bad.vtk") + " --unit mm", "binary"},
      {"drag " + block_ + " --at-mm 0 0 --by-mm 0 0 1 --out x.stl", "--at-mm"},
      {"smooth " + block_, "--out"}};
  for (const auto& [arguments, why] : bad) {
    const Ran ran = run_osteon("mesh " + arguments);
    EXPECT_EQ(ran.exit_code, 2) << arguments << ": " << ran.output;
    EXPECT_NE(ran.output.find(why), std::string::npos) << arguments << ": " << ran.output;
  }
}

TEST_F(Mesh, TetrahedraOfAFileAreReportedAndReadBack) {
  const std::string out = file("block.vtk");
  const Ran made = run_osteon("mesh tetrahedra " + block_ + " --cell-mm 3 --json --out " + out);
  ASSERT_EQ(made.exit_code, 0) << made.output;
  const auto report = nlohmann::json::parse(made.output, nullptr, false);
  EXPECT_GE(report["after"]["min_dihedral_deg"], 15);
  EXPECT_EQ(report["after"]["inverted"], 0);
  EXPECT_NEAR(report["volume_m3"], 64e-6, 0.64e-6);
  EXPECT_LT(report["vertex_distance_m"], 1e-9);
  EXPECT_EQ(report["boundary_closed"], true);
  const Ran read = run_osteon("mesh quality " + out + " --unit mm --json");
  ASSERT_EQ(read.exit_code, 0) << read.output;
  const auto back = nlohmann::json::parse(read.output, nullptr, false);
  EXPECT_EQ(back["tetrahedra"], report["tetrahedra"]);
  EXPECT_NEAR(back["volume_m3"], double(report["volume_m3"]), 1e-15);
  // Angles of 60 and 90 degrees lie on the rim of a bin: in mm they may fall to either side.
  EXPECT_NEAR(back["min_dihedral_deg"], double(report["after"]["min_dihedral_deg"]), 1e-6);
}

TEST_F(Mesh, ABoneOfACaseIsABodyToo) {
  const Ran made = run_osteon("mesh tetrahedra " + file("case") + "#block --cell-mm 4");
  EXPECT_NE(made.output.find("block: 12 triangles"), std::string::npos) << made.output;
  EXPECT_NE(made.output.find("0 inverted"), std::string::npos) << made.output;
}

TEST_F(Mesh, ACoarseCellExitsWithOneAndWarns) {
  const Ran made = run_osteon("mesh tetrahedra " + block_ + " --cell-mm 20");
  EXPECT_EQ(made.exit_code, 1) << made.output;
  EXPECT_NE(made.output.find("warning: the cell of 20 mm is too coarse"), std::string::npos)
      << made.output;
}

TEST_F(Mesh, ADraggedCornerIsWrittenAndACrossingReported) {
  const std::string out = file("dragged.stl");
  const Ran dragged = run_osteon("mesh drag " + block_ + " --at-mm 30 30 30 --by-mm 5 5 5 --out " +
                                 out + " --radius-mm 3 --fall-off cone");
  EXPECT_EQ(dragged.exit_code, 0) << dragged.output;
  EXPECT_NE(dragged.output.find("at (20.000, 20.000, 20.000) mm"), std::string::npos);
  EXPECT_TRUE(fs::exists(out));
  const Ran through = run_osteon("mesh drag " + block_ + " --at-mm 30 30 30 --by-mm -60 -61 -62" +
                                 " --out " + out + " --radius-mm 3");
  EXPECT_EQ(through.exit_code, 1) << through.output;
  EXPECT_NE(through.output.find("cross"), std::string::npos) << through.output;
}

TEST_F(Mesh, SmoothingAndDecimatingWriteASurface) {
  const fs::path bone = shared_dir() / "anatomy/wrist/lunate.stl";
  if (!fs::exists(bone)) GTEST_SKIP() << "no reference bones; set OSTEON_SHARED";
  for (const std::string what : {"smooth", "decimate"}) {
    const Ran ran =
        run_osteon("mesh " + what + " " + bone.string() + " --unit m --out " + file(what + ".stl"));
    EXPECT_EQ(ran.exit_code, 0) << ran.output;
    EXPECT_GT(fs::file_size(file(what + ".stl")), 1000u);
  }
}

}  // namespace
}  // namespace osteon::testing_cli
