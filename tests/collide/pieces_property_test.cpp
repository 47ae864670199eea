// What must hold of the contact with a bone of many convex pieces, on random poses. The distance to
// the mesh from which they were made is the judge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "collide/shapes.h"
#include "osteon/collide/lp_contact.h"
#include "osteon/hull/decompose.h"
#include "osteon/mesh/distance.h"
#include "osteon/mesh/isosurface.h"

namespace osteon {
namespace {

// A ball that a second one has hollowed.
const TriMesh& cup() {
  static const TriMesh mesh = [] {
    IsosurfaceOptions options;
    options.cell_m = 0.0012;
    const ScalarField field = [](const Vec3& p) {
      return std::max(p.norm() - 0.008, 0.007 - (p - Vec3(0, 0, 0.008)).norm());
    };
    return std::move(
        isosurface(field, {Vec3::Constant(-0.0095), Vec3::Constant(0.0095)}, options).value());
  }();
  return mesh;
}

const Decomposition& cut_up() {
  static const Decomposition pieces = std::move(*decompose(cup(), {0.0004, 32, 0.001}));
  return pieces;
}

std::vector<ConvexBody> bodies_of(const std::vector<Hull>& hulls, const Pose& X) {
  std::vector<ConvexBody> out;
  for (Hull hull : hulls) {
    for (Vec3& v : hull.vertices) v = X * v;
    for (Plane& plane : hull.planes) {
      const Vec3 n = X.rotate(plane.n);
      plane = {n, plane.d + n.dot(X.p)};
    }
    out.push_back(make_convex_body(hull));
  }
  return out;
}

const std::vector<ConvexBody>& cup_bodies() {
  static const std::vector<ConvexBody> bodies = bodies_of(cut_up().pieces, {});
  return bodies;
}

// The piece that the tool is deepest in, or nearest to.
struct UnionContact {
  LpDepth least;
  std::size_t piece = 0;
};

UnionContact touch(const std::vector<ConvexBody>& pieces, const ConvexBody& tool,
                   const Pose& X_AB) {
  UnionContact out;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const LpDepth depth = lp_depth(pieces[i], tool, X_AB);
    EXPECT_EQ(depth.status, LpStatus::kOptimal);
    if (i > 0 && !(depth.t < out.least.t)) continue;
    out = {depth, i};
  }
  return out;
}

ConvexBody any_tool(Random& random) {
  return shapes::body(shapes::random_hull(random, 10, {0.002, 0.001, 0.003}));
}

TEST(PiecesProperty, SwappingTheBodiesTurnsTheNormal) {
  ASSERT_GT(cup_bodies().size(), 3u);
  Random random(91);
  int hits = 0, sure = 0;
  for (int i = 0; i < 300; ++i) {
    const ConvexBody tool = any_tool(random);
    const Pose X_AB = shapes::random_pose(random, 0.011);
    const UnionContact c = touch(cup_bodies(), tool, X_AB);
    UnionContact back;
    for (std::size_t k = 0; k < cup_bodies().size(); ++k) {
      const LpDepth depth = lp_depth(tool, cup_bodies()[k], X_AB.inverse());
      if (k == 0 || depth.t < back.least.t) back = {depth, k};
    }
    EXPECT_NEAR(back.least.t, c.least.t, 1e-9);
    hits += c.least.t < 0;
    if (back.piece != c.piece) continue;  // two that are equally deep
    EXPECT_NEAR(back.least.gap, c.least.gap, 1e-9);
    EXPECT_LT((X_AB.rotate(back.least.nhat_AB_A) + c.least.nhat_AB_A).norm(), 1e-6);
    ++sure;
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(sure, 250);
}

TEST(PiecesProperty, RigidMotionChangesNothing) {
  Random random(92);
  for (int k = 0; k < 4; ++k) {
    const Pose X_WA = shapes::random_pose(random, 2.0);
    const std::vector<ConvexBody> moved = bodies_of(cut_up().pieces, X_WA);
    for (int i = 0; i < 60; ++i) {
      const ConvexBody tool = any_tool(random);
      const Pose X_AB = shapes::random_pose(random, 0.011);
      const UnionContact c = touch(cup_bodies(), tool, X_AB);
      const UnionContact d = touch(moved, tool, X_WA * X_AB);
      EXPECT_NEAR(d.least.t, c.least.t, 1e-9);
      if (d.piece != c.piece) continue;  // two that are equally deep
      EXPECT_NEAR(d.least.gap, c.least.gap, 1e-9);
      EXPECT_LT((d.least.nhat_AB_A - X_WA.rotate(c.least.nhat_AB_A)).norm(), 1e-6);
    }
  }
}

// The largest ball inside a piece and the tool stands over the mesh by no more than the pieces do,
// and a tool beside all pieces is beside the mesh.
TEST(PiecesProperty, TheContactIsThatOfTheMesh) {
  const MeshDistance mesh(cup());
  const double stands = cut_up().concavity_m + 1e-4;  // that is told on a grid
  Random random(93);
  int hits = 0, misses = 0;
  for (int i = 0; i < 400; ++i) {
    const ConvexBody tool = any_tool(random);
    const Pose X_AB = shapes::random_pose(random, 0.011);
    const LpDepth c = touch(cup_bodies(), tool, X_AB).least;
    if (c.t < 0) {
      ++hits;
      EXPECT_LE(mesh.closest(c.p_A).signed_distance, stands + c.t);
      continue;
    }
    ++misses;
    for (std::uint32_t v = 0; v < tool.vertex_count; ++v)
      EXPECT_GE(mesh.closest(X_AB * tool.vertex(v)).signed_distance, -1e-9);
  }
  EXPECT_GT(hits, 80);
  EXPECT_GT(misses, 80);
}

// A block cut at random into boxes: whatever is pushed in deepens just as in the whole block, up to
// where the first box ends.
TEST(PiecesProperty, PushingInDeepensMonotonically) {
  Random random(94);
  for (int i = 0; i < 40; ++i) {
    const double cut_x = random.uniform(-0.002, 0.002), cut_y = random.uniform(-0.002, 0.002);
    std::vector<ConvexBody> pieces;
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0}) {
        const Vec3 corner(x * 0.02, y * 0.02, -0.01);
        const Vec3 inner(cut_x, cut_y, 0.0);
        pieces.push_back(
            shapes::body(shapes::box(0.5 * (corner - inner).cwiseAbs(), 0.5 * (corner + inner))));
      }
    const ConvexBody tool = any_tool(random);
    const Quat turn = random.rotation();
    const double lowest = support(tool, turn.conjugate() * -Vec3::UnitZ());
    double last = 1e300;
    for (int step = 0; step < 60; ++step) {
      const double z = lowest + 0.0005 - 3e-5 * step;
      const UnionContact c = touch(pieces, tool, {Vec3(0, 0, z), turn});
      EXPECT_LE(c.least.t, last + 1e-12);
      EXPECT_EQ(c.least.t < 0, z < lowest) << step;
      last = c.least.t;
    }
    EXPECT_LT(last, -1e-5);
  }
}

}  // namespace
}  // namespace osteon
