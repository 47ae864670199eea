#include "osteon/mesh/tet_io.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/shapes.h"
#include "mesh/tet_checks.h"
#include "osteon/base/file.h"
#include "osteon/mesh/stuffing.h"

namespace osteon {
namespace {

const std::string kHead = "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\n";
const std::string kPoints = "POINTS 5 double\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n";
const std::string kCells = "CELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\n";
const std::string kTypes = "CELL_TYPES 2\n10\n10\n";

std::string error_of(const std::string& text, double unit = 1) {
  const auto mesh = load_vtk_from_memory(text, unit, "test.vtk");
  return mesh ? "read" : mesh.error().message();
}

void expect_error(const std::string& text, const std::string& what) {
  const std::string message = error_of(text);
  EXPECT_NE(message.find(what), std::string::npos) << message;
}

TEST(TetIo, ReadsAFileMadeByHand) {
  const auto mesh = load_vtk_from_memory(kHead + kPoints + kCells + kTypes, 0.001, "test.vtk");
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_EQ(mesh->vertices.size(), 5u);
  EXPECT_EQ(mesh->tets, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh->vertices[4], Vec3(0.001, 0.001, 0.001));
}

TEST(TetIo, ReadsEverySeedOfTheFuzzer) {
  const auto folder = std::filesystem::path(OSTEON_SOURCE_DIR) / "tests/fuzz/seeds/fuzz_tets";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto mesh = load_vtk(entry.path(), 1);
    EXPECT_TRUE(mesh) << mesh.error().message();
    ++files;
  }
  EXPECT_GE(files, 2);
}

// As ParaView writes it: offsets, a field before the points, metadata after them, data at the end.
TEST(TetIo, ReadsTheNewerWayOfWritingCells) {
  const std::string text =
      "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\n"
      "TIME 1 1 double\n0.5\nPOINTS 5 float\n0 0 0 1 0 0 0 1 0\n0 0 1 1 1 1\nMETADATA\n"
      "INFORMATION 0\n\nCELLS 4 11\nOFFSETS vtktypeint64\n0 4 7 11\nCONNECTIVITY vtktypeint64\n"
      "0 1 2 3 0 1 2\n1 2 3 4\nCELL_TYPES 3\n10\n5\n10\nPOINT_DATA 5\nSCALARS s float\n";
  const auto mesh = load_vtk_from_memory(text, 1, "test.vtk");
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_EQ(mesh->tets, (std::vector<Tetrahedron>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
}

TEST(TetIo, WhatIsWrittenReadsBackToTheBit) {
  const auto mesh =
      stuff_isosurface([](const Vec3& p) { return p.norm() - 0.01; },
                       {Vec3::Constant(-0.012), Vec3::Constant(0.012)}, {.cell_m = 0.003});
  ASSERT_TRUE(mesh);
  const auto file = test::fresh_folder("tet_io") / "ball.vtk";
  ASSERT_TRUE(save_vtk(*mesh, file, 1));
  const auto back = load_vtk(file, 1);
  ASSERT_TRUE(back) << back.error().message();
  EXPECT_EQ(checks::hash_of(*back), checks::hash_of(*mesh));
  ASSERT_TRUE(save_vtk(*mesh, file, 0.001));
  const auto in_mm = load_vtk(file, 0.001);
  ASSERT_TRUE(in_mm);
  EXPECT_EQ(in_mm->tets, mesh->tets);
  for (std::size_t i = 0; i < mesh->vertices.size(); ++i)
    ASSERT_LT((in_mm->vertices[i] - mesh->vertices[i]).norm(), 1e-17);
  EXPECT_NE(read_file(file)->find("POINTS"), std::string::npos);
}

TEST(TetIo, SaysWhatIsWrongAndWhere) {
  expect_error("", "is empty");
  expect_error("solid x", "not a legacy VTK");
  expect_error("# vtk DataFile Version 9.0\nx\nASCII\n", "version");
  expect_error("# vtk DataFile Version 3.0\nx\nBINARY\n", "binary");
  expect_error("# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n", "unstructured");
  expect_error(kHead, "truncated");
  expect_error(kHead + "CELLS 1 5\n", "before POINTS");
  expect_error(kHead + kPoints, "truncated");
  expect_error(kHead + kPoints + kPoints, "twice");
  expect_error(kHead + kPoints + kCells, "CELL_TYPES is missing");
  expect_error(kHead + kPoints + kCells + "CELL_TYPES 1\n10\n", "2 cells and 1 types");
  expect_error(kHead + kPoints + kCells + "CELL_TYPES 2\n10\n12\n", "type 12");
  expect_error(kHead + kPoints + "CELLS 1 5\n4 0 1 2 9\n", "test.vtk:12");
  expect_error(kHead + kPoints + "CELLS 1 5\n4 0 1 2 2\nCELL_TYPES 1\n10\n", "twice");
  expect_error(kHead + kPoints + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n", "four corners");
  expect_error(kHead + kPoints + "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n", "no tetrahedron");
  expect_error(kHead + "POINTS 1 double\n0 0 nan\nCELLS 0 0\nCELL_TYPES 0\n", "no tetrahedron");
  expect_error(kHead + kPoints + kCells + "COLOURS\n", "'COLOURS' is not expected");
}

TEST(TetIo, RefusesCoordinatesThatNoBodyHas) {
  const std::string far = "POINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 101\n";
  const std::string one = "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
  expect_error(kHead + far + one, "Check the unit");
  EXPECT_EQ(error_of(kHead + far + one, 0.001), "read");
  expect_error(kHead + "POINTS 4 double\n0 0 0\n1 0 0\n0 1 0\n0 0 inf\n" + one, "not finite");
  EXPECT_NE(error_of(kHead + far + one, 0).find("unit"), std::string::npos);
}

// A count of gigabytes in a short file must not make room for them.
TEST(TetIo, BelievesNoCountThatTheFileCannotHold) {
  expect_error(kHead + "POINTS 4000000000 double\n0 0 0\n", "do not fit");
  expect_error(kHead + "POINTS 99999999999999999999 double\n", "count");
  expect_error(kHead + kPoints + "CELLS 4000000000 20000000000\n", "do not fit");
  expect_error(kHead + kPoints + kCells + "CELL_TYPES 4000000000\n", "wrong count");
  expect_error(kHead + "FIELD f 1\na 4000000000 4000000000 double\n", "wrong size");
}

// Cut anywhere, the file is refused.
TEST(TetIo, RefusesEveryCutFile) {
  const std::string whole = kHead + kPoints + kCells + kTypes;
  for (std::size_t length = 0; length + 2 < whole.size(); ++length)
    EXPECT_NE(error_of(whole.substr(0, length)), "read") << length;
}

}  // namespace
}  // namespace osteon
