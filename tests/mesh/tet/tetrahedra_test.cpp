#include "osteon/mesh/tetrahedra.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/shapes.h"
#include "mesh/solids.h"
#include "mesh/surface_checks.h"
#include "mesh/tet_checks.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/mesh_io.h"
#include "osteon/mesh/repair.h"

namespace osteon {
namespace {

TetrahedraOptions tet_cell(double cell_m) {
  TetrahedraOptions options;
  options.cell_m = cell_m;
  return options;
}

std::string refusal(const TriMesh& surface, const TetrahedraOptions& options = {}) {
  const auto made = make_tetrahedra(surface, options);
  return made ? "made" : made.error().message();
}

TEST(Tetrahedra, RefusesWhatIsNotASolid) {
  EXPECT_NE(refusal({}).find("no triangles"), std::string::npos);
  TriMesh open = test::sphere(0.01, 8);
  open.triangles.pop_back();
  EXPECT_NE(refusal(open).find("3 open edges"), std::string::npos) << refusal(open);
  TriMesh inward = test::sphere(0.01, 8);
  for (Triangle& t : inward.triangles) test::flip(t);
  EXPECT_NE(refusal(inward).find("faces inwards"), std::string::npos);
  TriMesh nan = test::sphere(0.01, 8);
  nan.vertices[5].y() = std::nan("");
  EXPECT_NE(refusal(nan).find("vertex 5"), std::string::npos);
  TriMesh stray = test::sphere(0.01, 8);
  stray.triangles[3][1] = 100000;
  EXPECT_NE(refusal(stray).find("triangle 3"), std::string::npos);
  const TriMesh crossed =
      test::joined(test::sphere(0.01, 8), test::sphere(0.01, 8, Vec3(0.011, 0.0003, 0.0002)));
  EXPECT_NE(refusal(crossed).find("intersects itself"), std::string::npos) << refusal(crossed);
}

TEST(Tetrahedra, RefusesWhatIsTooThinOrTooMuch) {
  EXPECT_NE(refusal(test::turned_box(Vec3(0.02, 0.02, 0.0002)), tet_cell(0.004)).find("thinner"),
            std::string::npos);
  EXPECT_NE(refusal(test::sphere(0.01, 8), tet_cell(1e-6)).find("larger cell"), std::string::npos);
  EXPECT_NE(refusal(test::sphere(0.01, 8), tet_cell(-1)).find("positive"), std::string::npos);
  TetrahedraOptions few = tet_cell(0.001);
  few.most_tets = 100;
  EXPECT_NE(refusal(test::sphere(0.01, 8), few).find("100 tetrahedra"), std::string::npos);
}

// What holds of every mesh that is made: by checks of its own, not by the report.
void expect_sound(const TriMesh& surface, const Tetrahedra& made) {
  EXPECT_TRUE(checks::all_upright(made.mesh));
  EXPECT_TRUE(checks::faces_fit(made.mesh));
  const auto [least, most] = checks::dihedral_range_deg(made.mesh);
  EXPECT_GE(least, 15);
  EXPECT_LE(most, 165);
  EXPECT_NEAR(least, made.report.after.min_dihedral_rad * 180 / M_PI, 1e-4);
  EXPECT_EQ(made.report.after.inverted, 0u);
  const TriMesh shell = boundary(made.mesh).surface;
  EXPECT_TRUE(checks::is_closed_manifold(shell));
  EXPECT_EQ(checks::euler_number(shell), checks::euler_number(surface));
  EXPECT_NEAR(checks::signed_volume(shell) / checks::signed_volume(surface), 1, 0.01);
  const MeshDistance distance(surface);
  for (const Vec3& v : shell.vertices)
    ASSERT_LT(std::abs(distance.closest(v).signed_distance), 1e-9);
  EXPECT_TRUE(made.report.warnings.empty()) << made.report.warnings.front();
}

void expect_fills(const TriMesh& surface, double closed_form_volume_m3) {
  const auto made = make_tetrahedra(surface);
  ASSERT_TRUE(made) << made.error().message();
  expect_sound(surface, *made);
  EXPECT_NEAR(volume(made->mesh) / closed_form_volume_m3, 1, 0.02);
  EXPECT_GE(made->report.after.min_dihedral_rad, made->report.before.min_dihedral_rad);
}

TEST(Tetrahedra, FillASphere) { expect_fills(test::sphere(0.01, 32), 4 * M_PI / 3 * 1e-6); }

TEST(Tetrahedra, FillATorus) {
  expect_fills(test::torus(0.01, 0.004, 64, 24), 2 * M_PI * M_PI * 0.01 * 16e-6);
}

TEST(Tetrahedra, FillABox) {
  expect_fills(test::turned_box(Vec3(0.01, 0.012, 0.008)), 0.01 * 0.012 * 0.008);
}

// A band of 1 mm, and a ring of cartilage's thickness.
TEST(Tetrahedra, FillAThinBand) {
  expect_fills(test::turned_box(Vec3(0.006, 0.003, 0.001)), 0.006 * 0.003 * 0.001);
}

TEST(Tetrahedra, FillAThinDisc) {
  expect_fills(test::flat_ring(0.001, 0.004, 0.0008, 64), M_PI * (25e-6 - 1e-6) * 0.0008);
}

// Cartilage of 0.8 mm around a ball: a closed surface with a cavity.
TEST(Tetrahedra, FillAThinShell) {
  TriMesh hollow = test::sphere(0.0052, 24);
  for (Triangle& t : hollow.triangles) test::flip(t);
  expect_fills(test::joined(test::sphere(0.006, 24), hollow),
               4 * M_PI / 3 * (0.006 * 0.006 * 0.006 - 0.0052 * 0.0052 * 0.0052));
}

TEST(Tetrahedra, WarnsOfACellTooCoarse) {
  const auto made = make_tetrahedra(test::turned_box(Vec3(0.02, 0.02, 0.002)), tet_cell(0.002));
  ASSERT_TRUE(made) << made.error().message();
  ASSERT_FALSE(made->report.warnings.empty());
  EXPECT_NE(made->report.warnings[0].find("too coarse"), std::string::npos);
}

TEST(Tetrahedra, TheSameInputGivesTheSameBytes) {
  const TriMesh surface = test::torus(0.01, 0.003, 48, 16);
  const auto one = make_tetrahedra(surface, tet_cell(0.0015));
  const auto two = make_tetrahedra(surface, tet_cell(0.0015));
  ASSERT_TRUE(one && two);
  EXPECT_EQ(checks::hash_of(one->mesh), checks::hash_of(two->mesh));
}

TEST(Tetrahedra, FillARealBone) {
  const auto file = test::shared_folder() / "anatomy/wrist/scaphoid.stl";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference bone at " << file;
  auto bone = load_mesh(file, 1);
  ASSERT_TRUE(bone) << bone.error().message();
  repair(*bone);
  const auto made = make_tetrahedra(*bone);
  ASSERT_TRUE(made) << made.error().message();
  expect_sound(*bone, *made);
}

}  // namespace
}  // namespace osteon
