// Convex pieces that follow a mesh. The distance to the mesh is the oracle: it shares no code with
// the search.
#include "osteon/hull/decompose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "osteon/base/random.h"
#include "osteon/hull/validate.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

TriMesh grown(const ScalarField& field, const Vec3& half, double cell = 0.0008) {
  IsosurfaceOptions options;
  options.cell_m = cell;
  auto mesh = isosurface(field, {-half, half}, options);
  return std::move(mesh.value());
}

TriMesh ball(double radius) {
  return grown([=](const Vec3& p) { return p.norm() - radius; }, Vec3::Constant(1.3 * radius));
}

// A ball that a second one has hollowed.
TriMesh cup() {
  return grown(
      [](const Vec3& p) {
        return std::max(p.norm() - 0.008, 0.007 - (p - Vec3(0, 0, 0.008)).norm());
      },
      Vec3::Constant(0.0095));
}

TriMesh ring() {
  return grown(
      [](const Vec3& p) {
        const double r = std::sqrt(p.x() * p.x() + p.y() * p.y()) - 0.007;
        return std::sqrt(r * r + p.z() * p.z()) - 0.002;
      },
      Vec3(0.0105, 0.0105, 0.0035));
}

double height_over(const Hull& piece, const Vec3& p) {
  double most = -1e300;
  for (const Plane& plane : piece.planes) most = std::max(most, plane.signed_distance(p));
  return most;
}

// How far p is outside the union, at most.
double outside_all(const Decomposition& d, const Vec3& p) {
  double least = 1e300;
  for (const Hull& piece : d.pieces) least = std::min(least, height_over(piece, p));
  return least;
}

// Highest place of the pieces over the mesh, from points strewn over their triangles.
double stands_over(const Decomposition& d, const TriMesh& mesh) {
  const MeshDistance distance(mesh);
  Random random(7);
  double highest = 0;
  for (const Hull& piece : d.pieces)
    for (const Triangle& t : piece.triangles) {
      const Vec3 a = piece.vertices[t[0]];
      const Vec3 ab = piece.vertices[t[1]] - a;
      const Vec3 ac = piece.vertices[t[2]] - a;
      const int count = 1 + static_cast<int>(ab.cross(ac).norm() / 2e-7);
      for (int i = 0; i < count; ++i) {
        double u = random.uniform();
        double v = random.uniform();
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        highest = std::max(highest, distance.closest(a + u * ab + v * ac).signed_distance);
      }
    }
  return highest;
}

void expect_follows(const TriMesh& mesh, const DecomposeOptions& options) {
  const auto d = decompose(mesh, options);
  ASSERT_TRUE(d);
  EXPECT_LE(d->pieces.size(), options.max_pieces);
  EXPECT_LE(d->concavity_m, options.concavity_m);
  // To what the search leaves open.
  EXPECT_LE(stands_over(*d, mesh), options.concavity_m + 2e-5);
  // Nothing of the bone is left bare, neither its skin nor its inside.
  for (const Vec3& v : mesh.vertices) ASSERT_LE(outside_all(*d, v), 1e-9);
  const MeshDistance distance(mesh);
  const Aabb box = bounds(mesh);
  Random random(3);
  for (int i = 0; i < 4000; ++i) {
    Vec3 p;
    for (Eigen::Index k = 0; k < 3; ++k) p[k] = random.uniform(box.lo[k], box.hi[k]);
    if (distance.closest(p).signed_distance > -1e-5) continue;
    ASSERT_LE(outside_all(*d, p), 1e-5) << p.transpose();
  }
  for (const Hull& piece : d->pieces)
    EXPECT_THAT(validate_hull(piece, piece.vertices), testing::IsEmpty());
}

TEST(Decompose, NoHullNoPieces) {
  EXPECT_FALSE(decompose({}));
  EXPECT_FALSE(decompose({{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}}}));
}

TEST(Decompose, AnOpenMeshIsItsHull) {
  TriMesh mesh = cup();
  const auto hull = build_hull(mesh.vertices);
  mesh.triangles.pop_back();
  const auto d = decompose(mesh);
  ASSERT_TRUE(d);
  ASSERT_EQ(d->pieces.size(), 1u);
  EXPECT_EQ(d->pieces[0].vertices.size(), hull.hull->vertices.size());
}

TEST(Decompose, AConvexBodyStaysWhole) {
  const auto d = decompose(ball(0.008));
  ASSERT_TRUE(d);
  EXPECT_EQ(d->pieces.size(), 1u);
  EXPECT_LT(d->concavity_m, 1e-4);
}

TEST(Decompose, OnePieceIsTheHullAndItsHeightIsTold) {
  DecomposeOptions one;
  one.max_pieces = 1;
  const auto d = decompose(cup(), one);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->pieces.size(), 1u);
}

TEST(Decompose, FollowsACup) { expect_follows(cup(), {}); }

TEST(Decompose, FollowsARing) {
  DecomposeOptions options;
  options.concavity_m = 0.0004;
  expect_follows(ring(), options);
}

TEST(Decompose, KeepsToTheNumberOfPieces) {
  DecomposeOptions options;
  options.max_pieces = 5;
  const auto d = decompose(ring(), options);
  ASSERT_TRUE(d);
  EXPECT_LE(d->pieces.size(), 5u);
  EXPECT_GT(d->pieces.size(), 2u);
  EXPECT_GT(d->concavity_m, options.concavity_m);
}

TEST(Decompose, WallsOfACavityCountForNothing) {
  TriMesh shell = ball(0.008);
  const TriMesh inner = ball(0.005);
  const auto first = static_cast<std::uint32_t>(shell.vertices.size());
  shell.vertices.insert(shell.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (const Triangle& t : inner.triangles)
    shell.triangles.push_back({t[0] + first, t[2] + first, t[1] + first});
  const auto d = decompose(shell);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->pieces.size(), 1u);
}

TEST(Decompose, TheSameMeshGivesTheSameBytes) {
  DecomposeOptions coarse;
  coarse.concavity_m = 0.0005;
  const auto a = decompose(ring(), coarse);
  const auto b = decompose(ring(), coarse);
  ASSERT_EQ(a->pieces.size(), b->pieces.size());
  for (std::size_t i = 0; i < a->pieces.size(); ++i)
    EXPECT_EQ(a->pieces[i].vertices, b->pieces[i].vertices);
}

}  // namespace
}  // namespace osteon
