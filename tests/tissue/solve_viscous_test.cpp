#include <gtest/gtest.h>

#include "beam.h"
#include "osteon/tissue/solve.h"

namespace osteon {
namespace {

using test::Bar;

// The step of strain is a short ramp: it counts as one in the ramp's middle.
constexpr double kRamp_s = 0.2, kStrain = 0.002;

Bar viscous_bar() {
  Bar bar;
  bar.length_m = 0.02;
  bar.side_m = 0.01;
  bar.cells_across = 2;
  bar.young_pa = 2000;
  return bar;
}

// The pull on a bar that was stretched, after `time_s` from the middle of the ramp.
double pull_after(const Bar& bar, const std::vector<PronyTerm>& prony, double time_s,
                  bool sides_held) {
  SolveScene scene = test::stretched(bar, TissueModel::kNeoHookean, kStrain);
  scene.time_s = time_s + 0.5 * kRamp_s;
  scene.moved[0].over_s = kRamp_s;
  scene.material.prony = prony;
  scene.material.damping_per_s = 200;
  if (sides_held) {
    Aabb all = test::face_at(bar, 0);
    all.include(bar.length_m * Vec3::Ones());
    scene.fixed.push_back({all, {false, true, true}});
  }
  const auto result = solve(scene);
  EXPECT_TRUE(result && !result->lost);
  return result ? result->reactions[scene.fixed.size()].force_n.x() : 0;
}

// Sides held: the stress is (K + 4/3 mu(t)) strain, with mu(t) of two terms.
TEST(SolveViscous, HeldAllRoundItRelaxesAsItsPronyTerms) {
  const Bar bar = viscous_bar();
  const std::vector<PronyTerm> prony{{0.3, 0.5}, {0.4, 3}};
  for (const double t : {0.4, 1.0, 4.0}) {
    double share = 1;
    for (const PronyTerm& term : prony) share -= term.g * (1 - std::exp(-t / term.tau_s));
    const double expected =
        (bar.bulk_pa() + 4.0 / 3 * share * bar.shear_pa()) * kStrain * bar.area_m2();
    EXPECT_NEAR(pull_after(bar, prony, t, true) / expected, 1, 0.005) << t;
  }
}

// Sides free: with K that does not relax, the Laplace transform of Young's modulus has one pole,
//   E(t) = E_inf + (E_0 - E_inf) exp(-t / tau'),   tau' = tau (3 K + mu) / (3 K + mu (1 - g)).
TEST(SolveViscous, WithFreeSidesItRelaxesAsTheClosedForm) {
  const Bar bar = viscous_bar();
  const double g = 0.6, tau = 1, mu = bar.shear_pa(), three_k = 3 * bar.bulk_pa();
  const auto young = [&](double shear) { return 3 * three_k * shear / (three_k + shear); };
  const double slow = tau * (three_k + mu) / (three_k + mu * (1 - g));
  for (const double t : {0.3, 1.0, 3.0}) {
    const double late = young(mu * (1 - g));
    const double modulus = late + (young(mu) - late) * std::exp(-t / slow);
    const double expected = modulus * kStrain * bar.area_m2();
    EXPECT_NEAR(pull_after(bar, {{g, tau}}, t, false) / expected, 1, 0.01) << t;
  }
}

// A body that turns as a whole keeps what it has lost, turned with it: the sum of forces and their
// moment stay zero.
TEST(SolveViscous, LostStressTurnsWithTheBody) {
  HexSolidDef def;
  def.grid.cells = {3, 2, 2};
  def.material.prony = {{0.5, 0.01}};
  const auto solid = make_hex_solid(def);
  ASSERT_TRUE(solid);
  SolidState state = rest_state(*solid);
  for (const std::uint32_t s : solid->nodes) state.moved_m[0][s] = 0.1 * solid->rest_W(s).x();
  HexScratch scratch;
  const double dt = stable_step_s(*solid);
  const SolidState stretched = state;
  for (int n = 0; n < 200; ++n) {
    step(*solid, {}, dt, state, scratch);
    const auto lost = state.lost_pa;
    const auto tick = state.tick;
    state = stretched;
    state.lost_pa = lost;
    state.tick = tick;
  }
  EXPECT_TRUE(is_finite(state));
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  SolidState turned = state;
  for (const std::uint32_t s : solid->nodes) {
    const Vec3 at = turn * (solid->rest_W(s) + state.moved(s)) - solid->rest_W(s);
    for (std::size_t k = 0; k < 3; ++k) turned.moved_m[k][s] = at[static_cast<Eigen::Index>(k)];
  }
  step(*solid, {}, dt, state, scratch);
  const SolidState::Field before = scratch.force_n;
  step(*solid, {}, dt, turned, scratch);
  double most = 0, wrong = 0;
  for (const std::uint32_t s : solid->nodes) {
    const Vec3 f(before[0][s], before[1][s], before[2][s]);
    const Vec3 now(scratch.force_n[0][s], scratch.force_n[1][s], scratch.force_n[2][s]);
    most = std::max(most, f.norm());
    wrong = std::max(wrong, (turn * f - now).norm());
  }
  EXPECT_GT(most, 0);
  EXPECT_LT(wrong, 1e-10 * most);
}

TEST(SolveViscous, RefusesTermsThatAreNotSound) {
  SolidMaterial material;
  for (const auto& prony : std::vector<std::vector<PronyTerm>>{
           {{1, 1}}, {{-0.1, 1}}, {{0.1, 0}}, {{0.1, NAN}}, {{NAN, 1}}, {{0.5, 1}, {0.5, 2}}}) {
    material.prony = prony;
    const auto checked = check_material(material);
    ASSERT_FALSE(checked);
    EXPECT_NE(checked.error().message().find("material.prony"), std::string::npos);
  }
}

}  // namespace
}  // namespace osteon
