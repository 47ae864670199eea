#include "osteon/mesh/tet_improve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/surface_checks.h"
#include "mesh/tet_checks.h"
#include "osteon/base/random.h"
#include "osteon/mesh/stuffing.h"
#include "tet/tet_flips.h"
#include "tet/tet_work.h"

namespace osteon {
namespace {

Vec3 onto_ball(const Vec3& p, std::uint32_t&) { return 0.01 / p.norm() * p; }
const DistanceToSurface kAnyDistance = [](const Vec3&) { return 0.0; };

double largest_reach(const TetMesh& mesh) {
  double most = 0;
  for (const Vec3& v : mesh.vertices) most = std::max(most, v.norm());
  return most;
}

/// A stuffed ball whose inner vertices are shaken, and whose others slide on it, as far as none of
/// their elements turns over.
TetMesh shaken_ball(std::uint64_t seed) {
  TetMesh mesh =
      *stuff_isosurface([](const Vec3& p) { return p.norm() - 0.01; },
                        {Vec3::Constant(-0.012), Vec3::Constant(0.012)}, {.cell_m = 0.0025});
  TetWork work(std::move(mesh));
  Random random(seed);
  std::uint32_t hint = 0;
  for (std::uint32_t v = 0; v < work.vertex_count(); ++v) {
    const Vec3 direction = random.direction();
    Vec3 p = work.place(v) + 0.0009 * direction;
    if (work.on_boundary(v)) p = onto_ball(p, hint);
    if (work.least_worth_around(v, p, 0.0) > 1e-4) work.move(v, p);
  }
  return work.take();
}

TEST(LeastSine, OfKnownElements) {
  EXPECT_NEAR(least_sine(Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)),
              std::sqrt(8) / 3, 1e-15);
  EXPECT_EQ(least_sine(Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)), -1);
  EXPECT_EQ(least_sine(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)), -1);
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    TetMesh one;
    for (int k = 0; k < 4; ++k) one.vertices.push_back(random.direction());
    one.tets = {{0, 1, 2, 3}};
    if (signed_volume(corners_of(one, one.tets[0])) <= 0) one.tets = {{0, 1, 3, 2}};
    double least = 1;
    for (const double angle : dihedral_angles(corners_of(one, one.tets[0])))
      least = std::min(least, std::sin(angle));
    const std::array<Vec3, 4> c = corners_of(one, one.tets[0]);
    ASSERT_NEAR(least_sine(c[0], c[1], c[2], c[3]), least, 1e-7);
  }
}

TEST(TetImprove, AnEmptyMeshAndOneElementStay) {
  TetMesh empty;
  EXPECT_EQ(improve(empty, onto_ball).passes, 0);
  TetMesh one;
  one.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  one.tets = {{0, 1, 2, 3}};
  improve(one, [](const Vec3& p, std::uint32_t&) { return p; });
  EXPECT_EQ(one.tets.size(), 1u);
  EXPECT_TRUE(checks::all_upright(one));
}

TEST(TetImprove, MendsAShakenBall) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    TetMesh mesh = shaken_ball(seed);
    const auto before = checks::dihedral_range_deg(mesh);
    const double volume_before = volume(mesh);
    ASSERT_LT(before.first, 3);
    TetImproveOptions options;
    options.slack_m = 0.0001;
    const TetImproveReport report = improve(mesh, onto_ball, options);
    EXPECT_TRUE(checks::all_upright(mesh));
    EXPECT_TRUE(checks::faces_fit(mesh));
    const auto after = checks::dihedral_range_deg(mesh);
    EXPECT_GT(after.first, 15) << "seed " << seed << ", from " << before.first;
    EXPECT_LT(after.second, 165);
    EXPECT_GT(report.vertex_moves, 0u);
    EXPECT_GT(report.edges_removed + report.faces_removed, 0u);
    EXPECT_NEAR(volume(mesh) / volume_before, 1, 0.02);
    const TriMesh shell = boundary(mesh).surface;
    EXPECT_TRUE(checks::is_closed_manifold(shell));
    EXPECT_EQ(checks::euler_number(shell), 2);
    for (const Vec3& v : shell.vertices) ASSERT_NEAR(v.norm(), 0.01, 2e-7);
    EXPECT_LT(largest_reach(mesh), 0.0100002);
  }
}

// Three flat elements around an edge become two round ones, and the other way about.
TEST(TetFlips, AnEdgeBecomesAFaceAndAFaceAnEdge) {
  TetMesh mesh;
  for (int k = 0; k < 3; ++k)
    mesh.vertices.push_back(Vec3(std::cos(2 * M_PI * k / 3), std::sin(2 * M_PI * k / 3), 0));
  mesh.vertices.push_back(Vec3(0, 0, -0.8));
  mesh.vertices.push_back(Vec3(0, 0, 0.8));
  mesh.tets = {{3, 4, 0, 1}, {3, 4, 1, 2}, {3, 4, 2, 0}};
  ASSERT_TRUE(checks::all_upright(mesh));
  const double before = volume(mesh);
  TetWork work(mesh);
  ASSERT_TRUE(remove_edge(work, 3, 4, kAnyDistance, 0));
  const TetMesh two = work.take();
  EXPECT_EQ(two.tets.size(), 2u);
  EXPECT_TRUE(checks::all_upright(two));
  EXPECT_NEAR(volume(two), before, 1e-15);

  TetMesh flat = two;
  for (Vec3& v : flat.vertices) v.z() *= 0.3;
  TetWork other(flat);
  bool removed = false;
  for (std::size_t face = 0; face < 4; ++face) removed = removed || remove_face(other, 0, face);
  ASSERT_TRUE(removed);
  const TetMesh three = other.take();
  EXPECT_EQ(three.tets.size(), 3u);
  EXPECT_TRUE(checks::all_upright(three));
  EXPECT_NEAR(volume(three), 0.3 * before, 1e-14);
}

// An edge of the boundary goes only where the surface allows it.
TEST(TetFlips, TheBoundaryHoldsToTheSurface) {
  TetMesh mesh;  // a flat element on two taller ones: its edge 0-1 lies on the boundary
  mesh.vertices = {Vec3(-1, 0, 0.05), Vec3(1, 0, 0.05), Vec3(0, -1, 0), Vec3(0, 1, 0),
                   Vec3(0, 0, -1.5)};
  mesh.tets = {{0, 1, 2, 3}, {2, 3, 0, 4}, {3, 2, 1, 4}};
  for (Tetrahedron& t : mesh.tets)
    if (signed_volume(corners_of(mesh, t)) < 0) std::swap(t[2], t[3]);
  TetWork work(mesh);
  const DistanceToSurface height = [](const Vec3& p) { return std::abs(p.z() - 0.05); };
  EXPECT_FALSE(remove_edge(work, 0, 1, height, 0.01));
  EXPECT_TRUE(remove_edge(work, 0, 1, height, 0.1));
  const TetMesh left = work.take();
  EXPECT_EQ(left.tets.size(), 2u);
  EXPECT_TRUE(checks::is_closed_manifold(boundary(left).surface));
}

}  // namespace
}  // namespace osteon
