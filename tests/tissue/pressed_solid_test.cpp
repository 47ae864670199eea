#include "osteon/tissue/pressed_solid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "osteon/mesh/tri_mesh.h"
#include "osteon/tissue/solve.h"

namespace osteon {
namespace {

const Vec3 kBlockHalf(0.001, 0.001, 0.0005);
constexpr double kBlockCell_m = 0.0005;

TriMesh block_mesh(const Vec3& half) {
  TriMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back({(i & 1) ? half.x() : -half.x(), (i & 2) ? half.y() : -half.y(),
                             (i & 4) ? half.z() : -half.z()});
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// Held by its low face, pressed on its high one.
PressedSolidDef block_def() {
  PressedSolidDef def;
  auto field = DistanceField::make(block_mesh(kBlockHalf), {0.00025, 0.003, 0.001});
  EXPECT_TRUE(field);
  if (field) def.field = std::make_shared<const DistanceField>(std::move(*field));
  def.box = {-kBlockHalf, kBlockHalf};
  def.held = [](const Vec3& p) { return p.z() < -kBlockHalf.z() + 1e-6; };
  def.rests = [](const Vec3&) { return false; };
  return def;
}

TEST(PressedSolid, IsAsStiffAsWantedWhereverItIsPressed) {
  const auto solid = PressedSolid::make(block_def());
  ASSERT_TRUE(solid) << solid.error().message();
  for (const double x : {-0.001, -0.0003, 0.0, 0.0007}) {
    const SolidPush push = solid->push_at({x, 0, kBlockHalf.z()}, Vec3::UnitZ());
    EXPECT_NEAR(1 / solid->compliance(push, push), 900, 1e-6);
  }
}

// Slanting pushes all over the top, the same forces on the same nodes, solved with the explicit
// cubes of one point: no line of code in common.
TEST(PressedSolid, GivesWayAsTheExplicitCubesOfASceneDo) {
  const auto solid = PressedSolid::make(block_def());
  ASSERT_TRUE(solid) << solid.error().message();
  ASSERT_DOUBLE_EQ(solid->cell_m(), kBlockCell_m);
  SolveScene scene;
  scene.body.grid = HexGrid{{4, 4, 2}, kBlockCell_m, -kBlockHalf};
  constexpr double kYoung_pa = 1e5;
  scene.model = TissueModel::kNeoHookean;
  scene.material = {kYoung_pa, 0.3, 1000, 2e4};
  scene.time_s = 0.02;
  Aabb low{-kBlockHalf, kBlockHalf};
  low.hi.z() = low.lo.z();
  scene.fixed.push_back({low, {true, true, true}});
  std::vector<SolidPush> pushes;
  std::vector<Vec3> force(solid->nodes(), Vec3::Zero());
  for (int i = 0; i < 16; ++i) {
    const Vec3 cell(i % 4 - 1.5, i / 4 - 1.5, 0);
    SolidPush push = solid->push_at(kBlockCell_m * cell + kBlockHalf.z() * Vec3::UnitZ(),
                                    Vec3(0.6, 0, 0.8), 1e-4);
    for (std::uint32_t k = 0; k < push.patch.count; ++k)
      force[push.patch.node[k]] -= push.patch.weight[k] * push.force_n * push.gain * push.nhat;
    pushes.push_back(push);
  }
  for (std::size_t n = 0; n < force.size(); ++n) {
    const Vec3 p = solid->node_at(n), little = Vec3::Constant(1e-6);
    if (!force[n].isZero(0))
      scene.loads.push_back({{p - little, p + little}, kYoung_pa * force[n], 0.002});
    scene.probes_m.push_back(p);
  }
  const auto result = solve(scene);
  ASSERT_TRUE(result) << result.error().message();
  const auto moved = solid->moved(pushes);
  for (const SolidPush& at : pushes) {
    Vec3 way = Vec3::Zero();
    for (std::uint32_t k = 0; k < at.patch.count; ++k)
      way += at.patch.weight[k] * result->probes[at.patch.node[k]].moved_m;
    EXPECT_NEAR(at.nhat.dot(PressedSolid::moved_at(at.patch, moved)) / at.nhat.dot(way), 1, 0.1);
  }
}

TEST(PressedSolid, WhatOnePlaceDoesToAnotherIsMutual) {
  const auto solid = PressedSolid::make(block_def());
  ASSERT_TRUE(solid);
  const SolidPush a = solid->push_at({0.0009, 0, kBlockHalf.z()}, Vec3::UnitZ());
  const SolidPush b = solid->push_at({-0.0004, 0.0007, kBlockHalf.z()}, Vec3(0, 0.6, 0.8));
  EXPECT_NEAR(solid->compliance(a, b) / solid->compliance(b, a), 1, 1e-9);
  SolidPush pressed = a;
  pressed.force_n = 2;
  const auto moved = solid->moved(std::span(&pressed, 1));
  EXPECT_NEAR(-a.nhat.dot(PressedSolid::moved_at(a.patch, moved)) / (2 * solid->compliance(a, a)),
              1, 1e-9);
}

// Lying on its support it is stiffer than lifted from it.
TEST(PressedSolid, ASupportHoldsWhatIsPressedAndLetsGoOfWhatIsLifted) {
  PressedSolidDef def = block_def();
  def.held = [](const Vec3& p) { return p.x() < -kBlockHalf.x() + 1e-6; };
  def.rests = [](const Vec3& p) { return p.z() < 0; };
  const auto solid = PressedSolid::make(def);
  ASSERT_TRUE(solid) << solid.error().message();
  const SolidPush down = solid->push_at({0.0009, 0, kBlockHalf.z()}, Vec3::UnitZ());
  const SolidPush up = solid->push_at({0.0009, 0, -kBlockHalf.z()}, -Vec3::UnitZ());
  EXPECT_NEAR(solid->compliance(up, up) / solid->compliance(down, down), 2, 1e-9);
  // Between two tools it settles: each gives way to itself more than to the other.
  const double mutual = solid->compliance(up, down);
  EXPECT_LT(mutual * mutual, 0.95 * solid->compliance(up, up) * solid->compliance(down, down));
}

// A strip of 12 x 4 x 1 mm along x that is held at one or both ends.
const Vec3 kStripHalf(0.006, 0.002, 0.0005);

PressedSolidDef strip_def(double young_pa, double tension_pa, bool both_ends) {
  PressedSolidDef def;
  auto field = DistanceField::make(block_mesh(kStripHalf), {0.00025, 0.003, 0.001});
  EXPECT_TRUE(field);
  if (field) def.field = std::make_shared<const DistanceField>(std::move(*field));
  def.box = {-kStripHalf, kStripHalf};
  def.held = [both_ends](const Vec3& p) {
    return (both_ends ? std::abs(p.x()) : -p.x()) > kStripHalf.x() - 1e-6;
  };
  def.rests = [](const Vec3&) { return false; };
  def.young_pa = young_pa;
  def.tension_pa = tension_pa;
  return def;
}

// Mean way down of the nodes at `x_m`, for each newton that presses there all across.
double gives_across(const PressedSolid& solid, double x_m) {
  std::vector<SolidPush> pushes;
  constexpr int kPlaces = 9;
  for (int i = 0; i < kPlaces; ++i) {
    const double y = kStripHalf.y() * (2.0 * i / (kPlaces - 1) - 1);
    pushes.push_back(solid.push_at({x_m, y, 0}, Vec3::UnitZ(), 1.0 / kPlaces));
  }
  const std::vector<Vec3> moved = solid.moved(pushes);
  double sum = 0;
  for (const SolidPush& push : pushes) sum -= PressedSolid::moved_at(push.patch, moved).z();
  return sum / kPlaces;
}

// 4 T / L of a string of tension T, beside the strip's own 192 E I / L^3, which is a fortieth of
// it.
TEST(PressedSolid, FibresUnderTensionAreAString) {
  constexpr double kTension_pa = 1e5, kYoung_pa = 1e5;
  const auto solid = PressedSolid::make(strip_def(kYoung_pa, kTension_pa, true));
  ASSERT_TRUE(solid) << solid.error().message();
  const double length = 2 * kStripHalf.x(), wide = 2 * kStripHalf.y(), thick = 2 * kStripHalf.z();
  const double string = 4 * kTension_pa * wide * thick / length;
  const double beam = 16 * kYoung_pa * wide * std::pow(thick / length, 3);
  EXPECT_NEAR(gives_across(*solid, 0) * (string + beam), 1, 0.2);
}

// Some tension is left at the root, which cannot get narrower as the rest does.
TEST(PressedSolid, FibresThatNothingHoldsAtOneEndPullAtNothing) {
  const auto taut = PressedSolid::make(strip_def(1e5, 1e5, true));
  const auto slack = PressedSolid::make(strip_def(1e5, 0, true));
  const auto torn = PressedSolid::make(strip_def(1e5, 1e5, false));
  const auto loose = PressedSolid::make(strip_def(1e5, 0, false));
  ASSERT_TRUE(taut && slack && torn && loose);
  EXPECT_LT(gives_across(*taut, 0), 0.6 * gives_across(*slack, 0));
  EXPECT_NEAR(gives_across(*torn, 0.004) / gives_across(*loose, 0.004), 1, 0.15);
}

TEST(PressedSolid, OneWithAModulusIsAsStiffAsThatMakesIt) {
  const auto soft = PressedSolid::make(strip_def(1e5, 0, true));
  const auto firm = PressedSolid::make(strip_def(3e5, 0, true));
  ASSERT_TRUE(soft && firm);
  EXPECT_NEAR(gives_across(*soft, 0) / gives_across(*firm, 0), 3, 1e-9);
}

TEST(PressedSolid, RefusesWhatNothingHolds) {
  PressedSolidDef def = block_def();
  def.held = [](const Vec3&) { return false; };
  const auto solid = PressedSolid::make(def);
  ASSERT_FALSE(solid);
  EXPECT_NE(solid.error().what.find("nothing holds"), std::string::npos);
}

}  // namespace
}  // namespace osteon
