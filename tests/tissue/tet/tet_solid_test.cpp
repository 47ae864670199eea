#include "osteon/tissue/tet_solid.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "osteon/base/random.h"
#include "tet/tet_element.h"

namespace osteon {
namespace {

TetSolidDef def_of(std::array<std::uint32_t, 3> cells, TetOrder order, bool corotated) {
  HexGrid grid;
  grid.cells = cells;
  grid.cell_m = 0.01;
  TetSolidDef def;
  def.mesh = split_into_tetrahedra(grid);
  def.material = {1e5, 0.3, 1000, 0};
  def.order = order;
  def.corotated = corotated;
  return def;
}

TetSolid solid_of(std::array<std::uint32_t, 3> cells, TetOrder order, bool corotated) {
  auto solid = make_tet_solid(def_of(cells, order, corotated));
  EXPECT_TRUE(solid) << solid.error().message();
  return *solid;
}

SolidState moved_by(const TetSolid& solid, const Mat3& gradient) {
  SolidState state = state_at_rest(solid.rest_W.size(), true);
  for (std::size_t i = 0; i < solid.rest_W.size(); ++i) {
    const Vec3 u = gradient * solid.rest_W[i];
    for (std::size_t k = 0; k < 3; ++k) state.moved_m[k][i] = u[static_cast<Eigen::Index>(k)];
  }
  return state;
}

TEST(TetSolid, RefusesWhatIsNoSolid) {
  TetSolidDef def = def_of({2, 1, 1}, TetOrder::kLinear, false);
  def.mesh.tets[3] = {def.mesh.tets[3][1], def.mesh.tets[3][0], def.mesh.tets[3][2],
                      def.mesh.tets[3][3]};
  auto solid = make_tet_solid(def);
  ASSERT_FALSE(solid);
  EXPECT_NE(solid.error().what.find("tetrahedron 3 is inverted"), std::string::npos);
  def = def_of({3, 1, 1}, TetOrder::kLinear, false);
  def.mesh.tets.erase(def.mesh.tets.begin() + 6, def.mesh.tets.begin() + 12);
  solid = make_tet_solid(def);
  ASSERT_FALSE(solid);
  EXPECT_NE(solid.error().what.find("2 parts"), std::string::npos);
  def = def_of({1, 1, 1}, TetOrder::kLinear, false);
  def.mesh.vertices.push_back(Vec3::Zero());
  EXPECT_FALSE(make_tet_solid(def));
  def = def_of({1, 1, 1}, TetOrder::kLinear, false);
  def.mesh.vertices[0].x() = std::nan("");
  EXPECT_FALSE(make_tet_solid(def));
  def.mesh = {};
  EXPECT_FALSE(make_tet_solid(def));
}

TEST(TetSolid, CubesAreSplitIntoTheirVolumeAndMass) {
  const TetMesh mesh = split_into_tetrahedra({{3, 2, 4}, 0.01, Vec3(1, 2, 3)});
  EXPECT_EQ(mesh.tets.size(), 6u * 24);
  EXPECT_EQ(quality(mesh).inverted, 0u);
  EXPECT_NEAR(volume(mesh), 24e-6, 1e-15);
  EXPECT_NEAR(boundary(mesh).surface.triangles.size(), 2 * 2 * (6 + 8 + 12), 0);  // faces fit
  for (const TetOrder order : {TetOrder::kLinear, TetOrder::kQuadratic}) {
    double mass = 0;
    for (const double m : solid_of({3, 2, 4}, order, false).mass_kg) mass += m;
    EXPECT_NEAR(mass, 24e-3, 1e-12);
  }
}

TEST(TetSolid, RotationOfAStretchedTurnIsTheTurn) {
  Random random(4);
  for (int n = 0; n < 50; ++n) {
    const Mat3 turn = random.rotation().toRotationMatrix();
    const Mat3 axes = random.rotation().toRotationMatrix();
    Vec3 stretch;
    for (Eigen::Index k = 0; k < 3; ++k) stretch[k] = random.uniform(0.2, 3);
    const Mat3 f = turn * axes * stretch.asDiagonal() * axes.transpose();
    EXPECT_LT((rotation_of(f) - turn).norm(), 1e-12);
  }
  Mat3 inverted = Mat3::Identity();
  inverted(2, 2) = -0.1;
  EXPECT_NEAR(rotation_of(inverted).determinant(), 1, 1e-12);
  EXPECT_TRUE(rotation_of(Mat3::Zero()).allFinite());
}

TEST(TetSolid, PatchOfALinearFieldIsInBalance) {
  Mat3 gradient;
  gradient << 0.01, 0.005, -0.02, 0.002, -0.015, 0.01, 0.003, 0.007, 0.012;
  for (const TetOrder order : {TetOrder::kLinear, TetOrder::kQuadratic})
    for (const bool corotated : {false, true}) {
      const TetSolid solid = solid_of({3, 3, 3}, order, corotated);
      const auto force = elastic_forces(solid, moved_by(solid, gradient));
      double inner = 0, outer = 0;
      for (std::size_t i = 0; i < solid.rest_W.size(); ++i) {
        const Vec3& p = solid.rest_W[i];
        const bool inside = p.minCoeff() > 1e-6 && p.maxCoeff() < 0.03 - 1e-6;
        for (std::size_t k = 0; k < 3; ++k)
          (inside ? inner : outer) = std::max(inside ? inner : outer, std::abs(force[k][i]));
      }
      EXPECT_GT(outer, 1e-3);
      EXPECT_LT(inner, 1e-11 * outer);
    }
}

class TetForce : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(LinearAndCorotated, TetForce, ::testing::Bool());

TEST_P(TetForce, IsTheSlopeOfTheEnergy) {
  const TetSolid solid = solid_of({1, 2, 1}, TetOrder::kQuadratic, GetParam());
  Random random(2);
  SolidState state = state_at_rest(solid.rest_W.size(), true);
  for (auto& axis : state.moved_m)
    for (double& u : axis) u = random.uniform(-1e-3, 1e-3);
  const auto force = elastic_forces(solid, state);
  const auto held = [&](std::size_t k, std::size_t i, double by) {
    SolidState moved = state;
    moved.moved_m[k][i] += by;
    return strain_energy_j(solid, moved.moved_m, rotations(solid, moved.moved_m));
  };
  for (const std::size_t i : {std::size_t{0}, std::size_t{5}, solid.rest_W.size() - 1})
    for (std::size_t k = 0; k < 3; ++k) {
      const double slope = (held(k, i, 1e-6) - held(k, i, -1e-6)) / 2e-6;
      EXPECT_NEAR(-force[k][i], slope, 1e-6 * std::abs(slope) + 1e-9);
    }
}

TEST(TetSolid, TurningACorotatedSolidMakesNoForce) {
  const TetSolid solid = solid_of({2, 1, 1}, TetOrder::kQuadratic, true);
  const Mat3 turn = Quat(0.5, 0.5, -0.5, 0.5).toRotationMatrix() - Mat3::Identity();
  for (const auto& axis : elastic_forces(solid, moved_by(solid, turn)))
    for (const double f : axis) EXPECT_NEAR(f, 0, 1e-12);
}

TEST(TetSolid, PointsFollowAQuadraticField) {
  const TetSolid solid = solid_of({2, 2, 1}, TetOrder::kQuadratic, false);
  SolidState state = state_at_rest(solid.rest_W.size(), true);
  const auto field = [](const Vec3& p) { return p.x() * p.y() - 2 * p.z() * p.z() + p.x(); };
  for (std::size_t i = 0; i < solid.rest_W.size(); ++i)
    state.moved_m[1][i] = field(solid.rest_W[i]);
  const Vec3 p(0.0131, 0.0072, 0.0049);
  const auto at = find_point(solid, p);
  ASSERT_TRUE(at);
  EXPECT_NEAR(moved_at(solid, state, *at).y(), field(p), 1e-15);
  EXPECT_TRUE(find_point(solid, Vec3(0.02, 0.02, 0.01)));
  EXPECT_FALSE(find_point(solid, Vec3(0.021, 0.02, 0.01)));
}

TEST(TetStepper, AStepIsAFunctionOfTheState) {
  const TetSolid solid = solid_of({3, 1, 1}, TetOrder::kQuadratic, true);
  Supports supports;
  supports.gravity_m_per_s2 = {0, 0, -30};
  for (std::uint32_t i = 0; i < solid.rest_W.size(); ++i)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (solid.rest_W[i].x() < 1e-9) supports.held.push_back({i, k, 0, 0, 0});
  supports.entries = 1;
  const TetStepper stepper(solid, supports, 0.002), other(solid, supports, 0.002);
  SolidState state = stepper.rest_state();
  for (int n = 0; n < 5; ++n) ASSERT_TRUE(stepper.step(state));
  SolidState again = state;
  for (int n = 0; n < 5; ++n) ASSERT_TRUE(stepper.step(state));
  for (int n = 0; n < 5; ++n) ASSERT_TRUE(other.step(again));
  EXPECT_EQ(state, again);
  EXPECT_LT(state.moved(solid.corners - 1).z(), -1e-5);
}

TEST(TetStepper, RefusesAStateThatIsNotFinite) {
  const TetStepper stepper(solid_of({1, 1, 1}, TetOrder::kLinear, true), {}, 0.01);
  SolidState state = stepper.rest_state();
  state.moved_m[0][0] = std::nan("");
  const std::uint64_t tick = state.tick;
  EXPECT_FALSE(stepper.step(state));
  EXPECT_EQ(state.tick, tick);
  EXPECT_TRUE(find_lost(stepper.solid(), state));
}

// A bar of Poisson 0 that is held at one end swings along itself with the period 4 L / c.
TEST(TetStepper, BarSwingsAlongItselfWithItsPeriod) {
  TetSolidDef def = def_of({8, 1, 1}, TetOrder::kQuadratic, false);
  def.material.poisson = 0;
  const TetSolid solid = *make_tet_solid(def);
  Supports supports;
  for (std::uint32_t i = 0; i < solid.rest_W.size(); ++i)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (k > 0 || solid.rest_W[i].x() < 1e-9) supports.held.push_back({i, k, 0, 0, 0});
  supports.entries = 1;
  const double period = 4 * 0.08 / std::sqrt(1e5 / 1000);
  const TetStepper stepper(solid, supports, period / 60);
  SolidState state = stepper.rest_state();
  for (std::size_t i = 0; i < solid.rest_W.size(); ++i)
    state.velocity_m_per_s[0][i] = 0.01 * std::sin(std::numbers::pi * solid.rest_W[i].x() / 0.16);
  const std::size_t tip = solid.corners - 1;
  double last = 0, crossing = 0;
  int crossings = 0;
  for (int n = 1; crossings < 10 && n < 1000; ++n) {
    ASSERT_TRUE(stepper.step(state));
    const double now = state.moved_m[0][tip];
    if (n > 1 && last * now < 0) {
      ++crossings;
      crossing = (n - 1 + last / (last - now)) * stepper.step_s();
    }
    last = now;
  }
  EXPECT_NEAR(crossing / 5 / period, 1, 0.02);
}

}  // namespace
}  // namespace osteon
