#include <gtest/gtest.h>

#include "beam.h"
#include "osteon/tissue/solve.h"
#include "osteon/tissue/tet_solid.h"

namespace osteon {
namespace {

using test::Bar;

TEST(SolveTet, CantileverIsTimoshenkosWithin3Percent) {
  Bar bar;
  bar.length_m = 0.12;
  bar.cells_across = 2;
  constexpr double kForce = 0.003;
  for (const TissueModel model : {TissueModel::kLinear, TissueModel::kCorotated}) {
    const auto result = solve(test::cantilever(bar, model, kForce));
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_TRUE(result->settled);
    EXPECT_NEAR(-result->probes[0].moved_m.z() / test::timoshenko_m(bar, kForce), 1, 0.03);
    EXPECT_NEAR(result->reactions[0].force_n.z(), kForce, 1e-4 * kForce);
    EXPECT_EQ(result->elements, 6u * 12 * 2 * 2);
  }
}

// A scene of a grid as one of a mesh of tetrahedra.
SolveScene as_mesh(SolveScene scene) {
  scene.body.tets = split_into_tetrahedra(*scene.body.grid);
  scene.body.grid.reset();
  scene.body.vtk = "bar.vtk";
  return scene;
}

TEST(SolveTet, UniaxialNeoHookeanMeshIsTheClosedForm) {
  Bar bar;
  bar.length_m = 0.04;
  bar.cells_across = 1;
  for (const double strain : {-0.3, 0.3}) {
    const auto result = solve(as_mesh(test::stretched(bar, TissueModel::kNeoHookean, strain)));
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_TRUE(result->settled) << strain;
    const auto [force, side] = test::uniaxial_neo_hookean(bar, strain);
    EXPECT_NEAR(result->reactions[3].force_n.x() / force, 1, 0.01) << strain;
    EXPECT_NEAR(result->probes[0].moved_m.y(), (side - 1) * bar.side_m, 0.01 * bar.side_m * 0.1);
    EXPECT_EQ(result->elements, 6u * 2);
  }
}

TEST(SolveTet, NeoHookeanMeshBendsAsTimoshenkosBeam) {
  Bar bar;
  bar.length_m = 0.08;
  bar.cells_across = 2;
  constexpr double kForce = 0.003;
  const auto result = solve(as_mesh(test::cantilever(bar, TissueModel::kNeoHookean, kForce)));
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_TRUE(result->settled);
  EXPECT_NEAR(-result->probes[0].moved_m.z() / test::timoshenko_m(bar, kForce), 1, 0.03);
  EXPECT_NEAR(result->reactions[0].force_n.z(), kForce, 1e-4 * kForce);
}

TEST(SolveTet, ANeoHookeanMeshPulledApartIsLostAndGoesBack) {
  Bar bar;
  bar.length_m = 0.04;
  bar.cells_across = 1;
  const auto result = solve(as_mesh(test::cantilever(bar, TissueModel::kNeoHookean, 1000)));
  ASSERT_TRUE(result) << result.error().message();
  ASSERT_TRUE(result->lost);
  EXPECT_FALSE(result->settled);
  for (const Vec3& p : result->shape.points_m) EXPECT_TRUE(is_finite(p));
}

// A third of the length down: Bisshopp and Drucker's elastica (1945), which for P L^2 / (E I) = 1
// sinks by 0.3017 L; and the shear of Timoshenko's beam.
TEST(SolveTet, LargeDeflectionIsTheElasticas) {
  Bar bar;
  bar.length_m = 0.2;
  bar.poisson = 0;
  const double force = bar.young_pa * bar.second_moment_m4() / (bar.length_m * bar.length_m);
  const double shear = force * bar.length_m / (5.0 / 6 * bar.shear_pa() * bar.area_m2());
  for (const auto& [model, across] :
       {std::pair{TissueModel::kCorotated, 1u}, std::pair{TissueModel::kNeoHookean, 4u}}) {
    bar.cells_across = across;
    const auto result = solve(test::cantilever(bar, model, force));
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_FALSE(result->lost);
    EXPECT_NEAR(-result->probes[0].moved_m.z() / (0.3017 * bar.length_m + shear), 1, 0.03);
  }
}

TEST(SolveTet, LinearBarIsHookesAndNarrows) {
  Bar bar;
  bar.length_m = 0.04;
  bar.cells_across = 1;
  const auto result = solve(test::stretched(bar, TissueModel::kLinear, 0.01));
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_TRUE(result->settled);
  EXPECT_NEAR(result->reactions[3].force_n.x() / (0.01 * bar.young_pa * bar.area_m2()), 1, 1e-4);
  EXPECT_NEAR(result->probes[0].moved_m.y(), -0.3 * 0.01 * bar.side_m, 1e-5 * bar.side_m);
}

// A block that hardly changes its volume, between plates that it sticks to: cubes of one point and
// quadratic tetrahedra, which share no line of code, agree.
TEST(SolveTet, PressedBlockOfPoisson049DoesNotLock) {
  Bar bar;
  bar.length_m = bar.side_m = 0.02;
  bar.poisson = 0.49;
  const auto force = [&](TissueModel model, std::uint32_t across) {
    bar.cells_across = across;
    SolveScene scene = test::bar_scene(bar, model, 0.4);
    scene.material.damping_per_s = 200;
    scene.fixed.push_back({test::face_at(bar, 0), {true, true, true}});
    scene.moved.push_back(
        {test::face_at(bar, bar.length_m), {true, true, true}, {-0.0002, 0, 0}, 0.1});
    const auto result = solve(scene);
    EXPECT_TRUE(result && result->settled);
    return result ? result->reactions[1].force_n.x() : 0;
  };
  const double tetrahedra = force(TissueModel::kLinear, 3);
  const double cubes = force(TissueModel::kNeoHookean, 10);
  EXPECT_LT(cubes, 0);
  EXPECT_NEAR(tetrahedra / cubes, 1, 0.05);
}

TEST(SolveTet, SaysWhatIsWrongWithAMesh) {
  SolveScene scene = test::cantilever(Bar{}, TissueModel::kLinear, 0.001);
  scene.body.grid.reset();
  scene.body.tets = split_into_tetrahedra({{1, 1, 1}, 0.02, Vec3::Zero()});
  std::swap(scene.body.tets.tets[0][0], scene.body.tets.tets[0][1]);
  const auto result = solve(scene);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("mesh.vtk"), std::string::npos);
}

TEST(SolveTet, RefusesAMeshOfTwoParts) {
  SolveScene scene = test::cantilever(Bar{}, TissueModel::kCorotated, 0.001);
  scene.body.grid.reset();
  scene.body.tets = split_into_tetrahedra({{1, 1, 1}, 0.02, Vec3::Zero()});
  const TetMesh other = split_into_tetrahedra({{1, 1, 1}, 0.02, {0.05, 0, 0}});
  const auto shift = static_cast<std::uint32_t>(scene.body.tets.vertices.size());
  auto& mesh = scene.body.tets;
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Tetrahedron& t : other.tets)
    mesh.tets.push_back({t[0] + shift, t[1] + shift, t[2] + shift, t[3] + shift});
  const auto result = solve(scene);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().what.find("mesh.vtk"), std::string::npos);
  EXPECT_NE(result.error().what.find("2 parts"), std::string::npos) << result.error().what;
}

}  // namespace
}  // namespace osteon
