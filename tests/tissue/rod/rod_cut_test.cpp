// Rods that are cut in two.
#include "osteon/tissue/rod_cut.h"

#include <gtest/gtest.h>

#include "osteon/tissue/solve.h"
#include "tissue/rod/expect_rod_cuts.h"

namespace osteon {
namespace {

TEST(RodCut, NothingIsCutAtAnEnd) {
  const Rod rod = *make_rod({{{0, 0, 0}, {0.1, 0, 0}}, 0.001, 10, false, {}, 0.3});
  const RodState state = RodStepper(rod, {}, 1e-3).start_state();
  for (const std::size_t node : {0, 10, 11}) EXPECT_FALSE(cut_rod(rod, {}, state, node));
  EXPECT_TRUE(cut_rod(rod, {}, state, 9));
}

TEST(RodCut, KeepsMassLengthAndMomentumAndBothPartsMoveOn) {
  testing::expect_sound_after_random_rod_cuts(500, 7);
}

// A rod between two clamps, cut in the middle after it has come to rest: each half then is a
// cantilever under its own weight, whose end sinks by w L^4 / (8 E I).
TEST(RodCut, InASceneTheHalvesOfAClampedRodHangAsCantilevers) {
  const auto scene = parse_solve_scene(R"(
gravity_m_per_s2 = 9.81
[mesh]
rod = {points_mm = [[0, 0, 0], [100, 0, 0]], radius_mm = 1, segments = 80}
[material]
model = "rod"
young_kpa = 20000
poisson = 0.4
density_kg_per_m3 = 1000
damping_per_s = 30
[[fixed]]
box_mm = [[-0.1, -1, -1], [1.3, 1, 1]]
[[fixed]]
box_mm = [[98.7, -1, -1], [100.1, 1, 1]]
[[cut]]
at_mm = [50, 0, 0]
at_s = 0.5
[run]
time_s = 2
probe_mm = [[49.9, 0, 0], [50.1, 0, 0]]
)",
                                       "cut");
  ASSERT_TRUE(scene) << scene.error().message();
  const auto result = solve(*scene);
  ASSERT_TRUE(result) << result.error().message();
  EXPECT_TRUE(result->settled);
  const double L = 0.05 - 0.00125, second = 3.141592653589793 * 1e-12 / 4;
  const double w = 1000 * 9.81 * 3.141592653589793 * 1e-6;
  const double sinks = w * L * L * L * L / (8 * 20e6 * second);
  for (const SolveProbe& probe : result->probes)
    EXPECT_NEAR(-probe.moved_m.z(), sinks, 0.03 * sinks);
  // Each clamp bears its half.
  for (const SolveReaction& reaction : result->reactions)
    EXPECT_NEAR(reaction.force_n.z(), w * 0.05, 0.01 * w * 0.05);
}

TEST(RodCut, ACutBesideTheRodOrOfACubeIsRefused) {
  const std::string head =
      "[material]\nmodel = \"rod\"\nyoung_kpa = 1000\npoisson = 0.4\ndensity_kg_per_m3 = 1000\n"
      "[run]\ntime_s = 0.01\n[mesh]\nrod = {points_mm = [[0, 0, 0], [100, 0, 0]], radius_mm = 1, "
      "segments = 20}\n"
      "[[cut]]\nat_mm = ";
  for (const char* at : {"[50, 3, 0]", "[0, 0, 0]"}) {
    const auto scene = parse_solve_scene(head + at + "\n", "cut");
    ASSERT_TRUE(scene) << scene.error().message();
    const auto result = solve(*scene);
    ASSERT_FALSE(result) << at;
    EXPECT_NE(result.error().message().find("cut[0].at_mm"), std::string::npos);
  }
}

}  // namespace
}  // namespace osteon
