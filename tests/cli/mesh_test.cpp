// Tetrahedra and edited surfaces, through the command line alone.
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

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

// A strip with one side alone: no lid makes a solid of it.
void write_moebius_strip(const std::string& file) {
  constexpr int kAround = 40;
  std::ofstream out(file);
  for (int i = 0; i < kAround; ++i) {
    const double turn = 2 * std::numbers::pi * i / kAround;
    for (const double w : {-6.0, 6.0}) {
      const double r = 10 + w * std::cos(turn / 2);
      out << "v " << r * std::cos(turn) << ' ' << r * std::sin(turn) << ' '
          << w * std::sin(turn / 2) << '\n';
    }
  }
  for (int i = 1; i <= kAround; ++i) {
    const int a = 2 * i - 1, b = 2 * i, c = i < kAround ? a + 2 : 2, d = i < kAround ? b + 2 : 1;
    out << "f " << a << ' ' << b << ' ' << c << "\nf " << b << ' ' << d << ' ' << c << '\n';
  }
}

TEST_F(Mesh, AnOpenBoneIsFeltAsItsHullAndHasNoVolume) {
  fs::create_directories(dir_ / "strip");
  write_moebius_strip(file("strip/capitate.obj"));
  const std::string open = file("open_case");
  ASSERT_EQ(run_osteon("import mesh " + file("strip") + " --unit mm --out " + open).exit_code, 0);
  const Ran info = run_osteon("case info " + open);
  EXPECT_NE(info.output.find("hull\n"), std::string::npos) << info.output;
  EXPECT_EQ(info.output.find("0.000"), std::string::npos) << info.output;
  const auto json = nlohmann::json::parse(run_osteon("case info --json " + open).output);
  EXPECT_TRUE(json["bones"][0]["volume_cm3"].is_null());
  EXPECT_EQ(json["bones"][0]["felt"], "hull");
  const Ran check = run_osteon("case check " + open);
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.output.find("felt as its convex hull"), std::string::npos) << check.output;
}

}  // namespace
}  // namespace osteon::testing_cli
