#include "osteon/mesh/stuffing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/surface_checks.h"
#include "mesh/tet_checks.h"
#include "osteon/base/random.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

const Aabb kBox{Vec3::Constant(-0.012), Vec3::Constant(0.012)};

ScalarField ball(double r) {
  return [r](const Vec3& p) { return p.norm() - r; };
}

StuffingOptions stuffing_cell(double cell_m) {
  StuffingOptions options;
  options.cell_m = cell_m;
  return options;
}

TEST(Stuffing, RefusesWhatCannotBeStuffed) {
  EXPECT_FALSE(stuff_isosurface(ball(0.01), kBox, stuffing_cell(0)));
  EXPECT_FALSE(stuff_isosurface(ball(0.01), kBox, stuffing_cell(std::nan(""))));
  EXPECT_FALSE(stuff_isosurface(ball(0.01), Aabb{}, stuffing_cell(0.001)));
  const auto huge = stuff_isosurface(ball(0.01), kBox, stuffing_cell(1e-6));
  ASSERT_FALSE(huge);
  EXPECT_NE(huge.error().message().find("million cubes"), std::string::npos);
  const auto empty = stuff_isosurface([](const Vec3&) { return 1.0; }, kBox, stuffing_cell(0.001));
  ASSERT_FALSE(empty);
  EXPECT_NE(empty.error().message().find("thinner than a cell"), std::string::npos);
  const auto full = stuff_isosurface([](const Vec3&) { return -1.0; }, kBox, stuffing_cell(0.001));
  ASSERT_FALSE(full);
  EXPECT_NE(full.error().message().find("rim"), std::string::npos);
  const auto nan =
      stuff_isosurface([](const Vec3& p) { return p.x() > 0 ? std::nan("") : p.norm() - 0.01; },
                       kBox, stuffing_cell(0.001));
  ASSERT_FALSE(nan);
  EXPECT_NE(nan.error().message().find("finite"), std::string::npos);
}

TEST(Stuffing, RefusesMoreElementsThanAllowed) {
  StuffingOptions options = stuffing_cell(0.001);
  options.most_tets = 1000;
  const auto many = stuff_isosurface(ball(0.01), kBox, options);
  ASSERT_FALSE(many);
  EXPECT_NE(many.error().message().find("1000 tetrahedra"), std::string::npos);
}

TEST(Stuffing, FillsABall) {
  const auto mesh = stuff_isosurface(ball(0.01), kBox, stuffing_cell(0.001));
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_TRUE(checks::all_upright(*mesh));
  EXPECT_TRUE(checks::faces_fit(*mesh));
  EXPECT_NEAR(volume(*mesh) / (4 * M_PI / 3 * 1e-6), 1, 0.01);
  const TetBoundary shell = boundary(*mesh);
  EXPECT_TRUE(checks::is_closed_manifold(shell.surface));
  EXPECT_EQ(checks::euler_number(shell.surface), 2);
  EXPECT_NEAR(checks::signed_volume(shell.surface), volume(*mesh), 1e-15);
  for (const Vec3& v : shell.surface.vertices) ASSERT_NEAR(v.norm(), 0.01, 2e-7);
}

// The paper's bounds, over rough random fields: sums of waves that the lattice does not resolve.
TEST(Stuffing, AnglesKeepToTheBoundsOfThePaper) {
  Random random(7);
  double least = 180, most = 0;
  for (int n = 0; n < 12; ++n) {
    std::array<Vec3, 5> wave;
    for (Vec3& w : wave) {
      const Vec3 direction = random.direction();
      w = random.uniform(200, 2500) * direction;
    }
    const auto field = [wave](const Vec3& p) {
      double sum = p.norm() - 0.007;
      for (const Vec3& w : wave) sum += 0.0008 * std::sin(w.dot(p));
      return sum;
    };
    StuffingOptions options = stuffing_cell(0.0015);
    options.stretch = 1 + 5 * 0.0008 * 2500;
    const auto mesh = stuff_isosurface(field, kBox, options);
    ASSERT_TRUE(mesh) << mesh.error().message();
    ASSERT_TRUE(checks::all_upright(*mesh));
    ASSERT_TRUE(checks::faces_fit(*mesh));
    const auto [smallest, largest] = checks::dihedral_range_deg(*mesh);
    least = std::min(least, smallest);
    most = std::max(most, largest);
  }
  EXPECT_GT(least, 10.7);
  EXPECT_LT(most, 164.8);
  RecordProperty("least_deg", std::to_string(least));
}

// On every compiler and at every level of optimisation.
TEST(Stuffing, TheBytesAreKnown) {
  const auto ring = [](const Vec3& p) {
    const double across = std::sqrt(p.x() * p.x() + p.y() * p.y()) - 0.007;
    return std::sqrt(across * across + p.z() * p.z()) - 0.003;
  };
  const auto mesh = stuff_isosurface(ring, kBox, stuffing_cell(0.0013));
  ASSERT_TRUE(mesh) << mesh.error().message();
  EXPECT_EQ(checks::hash_of(*mesh), 11985752004748991252u);
}

// Blocks that the promise places clear of the surface are skipped: the same mesh comes out as when
// nothing may be skipped.
TEST(Stuffing, SkippingChangesNothing) {
  StuffingOptions thorough = stuffing_cell(0.0008);
  thorough.slack_m = 1;
  const auto quick = stuff_isosurface(ball(0.008), kBox, stuffing_cell(0.0008));
  const auto slow = stuff_isosurface(ball(0.008), kBox, thorough);
  ASSERT_TRUE(quick && slow);
  EXPECT_EQ(checks::hash_of(*quick), checks::hash_of(*slow));
}

}  // namespace
}  // namespace osteon
