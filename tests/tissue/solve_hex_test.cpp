#include <gtest/gtest.h>

#include "beam.h"
#include "osteon/tissue/solve.h"

namespace osteon {
namespace {

using test::Bar;

constexpr TissueModel kHex = TissueModel::kNeoHookean;

TEST(SolveHex, CantileverIsTimoshenkosWithin3Percent) {
  for (const std::uint32_t across : {4u, 6u}) {
    Bar bar;
    bar.cells_across = across;
    bar.length_m = 0.12;
    constexpr double kForce = 0.003;
    const auto result = solve(test::cantilever(bar, kHex, kForce));
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_TRUE(result->settled);
    const double expected = test::timoshenko_m(bar, kForce);
    EXPECT_NEAR(-result->probes[0].moved_m.z() / expected, 1, 0.03) << across;
    EXPECT_NEAR(result->reactions[0].force_n.z(), kForce, 1e-4 * kForce);
    EXPECT_LT(result->energy.hourglass_j, 0.05 * result->energy.strain_j);
    // Linear: the energy is half of force times way.
    EXPECT_NEAR((result->energy.strain_j + result->energy.hourglass_j) /
                    (-0.5 * kForce * result->probes[0].moved_m.z()),
                1, 0.02);
  }
}

TEST(SolveHex, UniaxialNeoHookeanBarIsTheClosedForm) {
  Bar bar;
  bar.length_m = 0.04;
  bar.cells_across = 2;
  for (const double strain : {-0.3, -0.1, 0.1, 0.3}) {
    const auto result = solve(test::stretched(bar, kHex, strain));
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_TRUE(result->settled) << strain;
    const auto [force, side] = test::uniaxial_neo_hookean(bar, strain);
    EXPECT_NEAR(result->reactions[3].force_n.x() / force, 1, 0.01) << strain;
    EXPECT_NEAR(result->probes[0].moved_m.y(), (side - 1) * bar.side_m, 0.01 * bar.side_m * 0.1);
  }
}

TEST(SolveHex, ReactionsBalanceLoadsAndWeight) {
  Bar bar;
  SolveScene scene = test::cantilever(bar, kHex, 0.004);
  scene.gravity_m_per_s2 = {0, 0, -1};
  const auto result = solve(scene);
  ASSERT_TRUE(result);
  const double weight = bar.mass_kg() * 1;
  EXPECT_NEAR(result->reactions[0].force_n.z(), 0.004 + weight, 1e-3 * weight);
  EXPECT_NEAR(result->reactions[0].force_n.x(), 0, 1e-3 * weight);
}

TEST(SolveHex, LosingAnElementGoesBackToTheLastSoundState) {
  Bar bar;
  bar.length_m = 0.04;
  SolveScene scene = test::cantilever(bar, kHex, 1000);
  const auto result = solve(scene);
  ASSERT_TRUE(result);
  ASSERT_TRUE(result->lost);
  EXPECT_FALSE(result->settled);
  EXPECT_NE(result->lost->part.find("hexahedron"), std::string::npos);
  for (const Vec3& p : result->shape.points_m) EXPECT_TRUE(is_finite(p));
  EXPECT_TRUE(std::isfinite(result->energy.strain_j));
}

TEST(SolveHex, TheSameSceneGivesTheSameBits) {
  const SolveScene scene = test::cantilever(Bar{}, kHex, 0.004);
  const auto first = solve(scene), again = solve(scene);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(solve_vtk(first->shape), solve_vtk(again->shape));
}

TEST(SolveHex, NamesTheKeyOfABoxWithoutNodesAndOfAProbeOutside) {
  SolveScene scene = test::cantilever(Bar{}, kHex, 0.004);
  scene.fixed[0].box_m = Aabb{Vec3::Constant(1), Vec3::Constant(2)};
  auto result = solve(scene);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("fixed[0].box_mm"), std::string::npos);
  scene = test::cantilever(Bar{}, kHex, 0.004);
  scene.probes_m.push_back(Vec3::Constant(1));
  result = solve(scene);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("run.probe_mm[1]"), std::string::npos);
}

}  // namespace
}  // namespace osteon
