#include "osteon/tissue/hex_solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hex/hex_element.h"
#include "hex/hex_forces.h"
#include "osteon/base/random.h"

namespace osteon {
namespace {

HexSolid solid_of(std::array<std::uint32_t, 3> cells, double poisson = 0.45) {
  HexSolidDef def;
  def.grid.cells = cells;
  def.grid.cell_m = 0.004;
  def.grid.origin_W = {0.01, -0.02, 0.03};
  def.material.poisson = poisson;
  auto solid = make_hex_solid(def);
  EXPECT_TRUE(solid) << solid.error().message();
  return *solid;
}

// Every node by the same affine map of its rest place.
SolidState affine(const HexSolid& solid, const Mat3& gradient) {
  SolidState state = rest_state(solid);
  for (const std::uint32_t s : solid.nodes) {
    const Vec3 u = gradient * (solid.rest_W(s) - solid.grid.origin_W);
    for (std::size_t k = 0; k < 3; ++k) state.moved_m[k][s] = u[static_cast<Eigen::Index>(k)];
  }
  return state;
}

SolidState shaken(const HexSolid& solid, std::uint64_t seed, double size_m, double speed) {
  Random random(seed);
  SolidState state = rest_state(solid);
  for (const std::uint32_t s : solid.nodes)
    for (std::size_t k = 0; k < 3; ++k) {
      state.moved_m[k][s] = random.uniform(-size_m, size_m);
      state.velocity_m_per_s[k][s] = random.uniform(-speed, speed);
    }
  return state;
}

TEST(HexSolid, RefusesWhatIsNoGrid) {
  for (const std::array<std::uint32_t, 3> cells :
       {std::array<std::uint32_t, 3>{0, 1, 1}, {1, 1, 1001}, {1000, 1000, 1000}}) {
    HexSolidDef def;
    def.grid.cells = cells;
    const auto solid = make_hex_solid(def);
    ASSERT_FALSE(solid);
    EXPECT_EQ(solid.error().where, "mesh.grid.cells");
  }
  HexSolidDef def;
  def.grid.cell_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(make_hex_solid(def).error().where, "mesh.grid.cell_mm");
  def = {};
  def.fill = {0};
  EXPECT_FALSE(make_hex_solid(def));
  def.fill = {0.5, 0.5};
  EXPECT_FALSE(make_hex_solid(def));
}

TEST(HexSolid, RefusesWhatIsNoMaterial) {
  const auto where = [](SolidMaterial material) {
    HexSolidDef def;
    def.material = std::move(material);
    const auto solid = make_hex_solid(def);
    return solid ? std::string("fine") : solid.error().where;
  };
  EXPECT_EQ(where({3000, 0.45, 1000, 0}), "fine");
  EXPECT_EQ(where({-1, 0.45, 1000, 0}), "material.young_kpa");
  EXPECT_EQ(where({3000, 0.5, 1000, 0}), "material.poisson");
  EXPECT_EQ(where({3000, std::nan(""), 1000, 0}), "material.poisson");
  EXPECT_EQ(where({3000, 0.45, 0, 0}), "material.density_kg_per_m3");
  EXPECT_EQ(where({3000, 0.45, 1000, -1}), "material.damping_per_s");
}

TEST(HexSolid, MassIsDensityTimesVolume) {
  HexSolidDef def;
  def.grid.cells = {5, 3, 2};
  def.fill.assign(30, 1.0);
  def.fill[7] = 0;
  def.fill[8] = 0.25;
  const auto solid = make_hex_solid(def);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->elements, 29u);
  double mass = 0;
  for (const double m : solid->mass_kg) mass += m;
  EXPECT_NEAR(mass, 1000 * std::pow(0.004, 3) * 28.25, 1e-15);
}

TEST(HexSolid, SlotsAndPlacesBelongTogether) {
  const HexSolid solid = solid_of({3, 11, 2});
  EXPECT_EQ(solid.axis[0], 1u);  // rows along the longest axis
  for (std::size_t z = 0; z <= 2; ++z)
    for (std::size_t y = 0; y <= 11; ++y)
      for (std::size_t x = 0; x <= 3; ++x)
        EXPECT_EQ(solid.place(solid.slot(x, y, z)), (std::array<std::size_t, 3>{x, y, z}));
}

TEST(HexElement, InverseCubeRootIsRightToTheLastBits) {
  for (double j = 0.01; j < 200; j *= 1.0037)
    EXPECT_NEAR(hex::inverse_cube_root(j) * std::cbrt(j), 1, 5e-16) << j;
  EXPECT_DOUBLE_EQ(hex::inverse_cube_root(1.0), 1);
}

TEST(HexElement, ModesAndTheirTransposeAreOneAnothersTranspose) {
  // <to_modes(u), m> = <u, from_modes(m)> for any u and m.
  Random random(3);
  double u[8], m[7];
  for (double& x : u) x = random.uniform(-1, 1);
  for (double& x : m) x = random.uniform(-1, 1);
  const auto s = hex::to_modes(u[0], u[1], u[2], u[3], u[4], u[5], u[6], u[7]);
  const auto v = hex::from_modes<double>({m[0], m[1], m[2], m[3], m[4], m[5], m[6]});
  const double left =
      s.x * m[0] + s.y * m[1] + s.z * m[2] + s.xy * m[3] + s.xz * m[4] + s.yz * m[5] + s.xyz * m[6];
  const double right = (v.even0 - v.odd0) * u[0] + (v.even0 + v.odd0) * u[1] +
                       (v.even1 - v.odd1) * u[2] + (v.even1 + v.odd1) * u[3] +
                       (v.even2 - v.odd2) * u[4] + (v.even2 + v.odd2) * u[5] +
                       (v.even3 - v.odd3) * u[6] + (v.even3 + v.odd3) * u[7];
  EXPECT_NEAR(left, right, 1e-14);
}

// A field that is linear everywhere has no force on the inner nodes, whatever its size.
TEST(HexSolid, PatchOfALinearFieldIsInBalance) {
  const HexSolid solid = solid_of({4, 3, 5});
  Mat3 gradient;
  gradient << 0.1, 0.05, -0.2, 0.02, -0.15, 0.1, 0.03, 0.07, 0.12;
  const SolidState state = affine(solid, gradient);
  HexScratch scratch;
  reckon_forces(solid, {}, 0, state, scratch);
  double largest = 0, inner = 0;
  for (const std::uint32_t s : solid.nodes) {
    const auto at = solid.place(s);
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside = inside && at[k] > 0 && at[k] < solid.grid.cells[k];
    for (std::size_t k = 0; k < 3; ++k) {
      const double f = std::abs(scratch.force_n[k][s]);
      (inside ? inner : largest) = std::max(inside ? inner : largest, f);
    }
  }
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(inner, 1e-12 * largest);
}

TEST(HexSolid, ForceIsTheSlopeOfTheEnergy) {
  const HexSolid solid = solid_of({3, 2, 2});
  SolidState state = shaken(solid, 5, 4e-4, 0);
  HexScratch scratch;
  reckon_forces(solid, {}, 0, state, scratch);
  const SolidState::Field force = scratch.force_n;
  const auto held = [&](std::size_t k, std::uint32_t s, double by) {
    SolidState moved = state;
    moved.moved_m[k][s] += by;
    const SolidEnergy e = energy(solid, {}, 1e-4, moved, scratch);
    return e.strain_j + e.hourglass_j;
  };
  constexpr double kBy = 1e-7;
  for (const std::uint32_t s : {solid.nodes[0], solid.nodes[7], solid.nodes.back()})
    for (std::size_t k = 0; k < 3; ++k) {
      const double slope = (held(k, s, kBy) - held(k, s, -kBy)) / (2 * kBy);
      EXPECT_NEAR(-force[k][s], slope, 1e-6 * std::abs(slope) + 1e-9);
    }
}

TEST(HexSolid, TurningAsAWholeMakesNoForce) {
  const HexSolid solid = solid_of({3, 2, 2});
  const Mat3 turn = Quat(0.5, 0.5, -0.5, 0.5).toRotationMatrix() - Mat3::Identity();
  HexScratch scratch;
  reckon_forces(solid, {}, 0, affine(solid, turn), scratch);
  for (const auto& axis : scratch.force_n)
    for (const double f : axis) EXPECT_NEAR(f, 0, 1e-15);
}

TEST(HexSolid, EveryRegisterWidthGivesTheSameBits) {
  const HexSolid solid = solid_of({13, 3, 2});
  const SolidState state = shaken(solid, 11, 5e-4, 0);
  const hex::RowConstants constants = row_constants(solid);
  const std::size_t count = solid.row_stride - 1;
  const auto reckoned = [&](hex::RowWork work) {
    SolidState::Field force;
    for (auto& f : force) f.assign(solid.slots, 0.0);
    std::vector<double> room(hex::kOutputs * count), lowest(count, 1.0);
    hex::Row row{{}, {}, solid.fill.data(), lowest.data(), room.data(), static_cast<long>(count)};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t r = 0; r < 4; ++r) {
        const std::size_t at = r % 2 * solid.row_stride + r / 2 * solid.layer_stride;
        row.moved[k][r] = state.moved_m[k].data() + at;
        row.force[k][r] = force[k].data() + at;
      }
    work(constants, row);
    force[0].insert(force[0].end(), lowest.begin(), lowest.end());
    return force;
  };
  const auto base = reckoned(hex::row_forces_base);
  EXPECT_GT(std::abs(base[1][3]), 0);
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    EXPECT_EQ(base, reckoned(hex::row_forces_avx2));
  }
  if (__builtin_cpu_supports("avx512f")) {
    EXPECT_EQ(base, reckoned(hex::row_forces_avx512));
  }
#endif
}

TEST(HexSolid, AStepIsAFunctionOfTheState) {
  const HexSolid solid = solid_of({5, 4, 3});
  const double dt = stable_step_s(solid);
  SolidState first = shaken(solid, 1, 2e-4, 0.01);
  HexScratch scratch;
  for (int n = 0; n < 20; ++n) step(solid, {}, dt, first, scratch);
  const SolidState saved = first;
  for (int n = 0; n < 20; ++n) step(solid, {}, dt, first, scratch);
  SolidState again = saved;
  HexScratch fresh;
  for (int n = 0; n < 20; ++n) step(solid, {}, dt, again, fresh);
  EXPECT_EQ(first, again);
  EXPECT_EQ(hash_of(first), hash_of(again));
  EXPECT_NE(hash_of(first), hash_of(saved));
}

// Free in space, stretched, thrown and turning, 10^5 steps: momentum to 1e-9, energy to 0.1 %.
TEST(HexSolid, KeepsMomentumAndEnergyOverManySteps) {
  const HexSolid solid = solid_of({3, 2, 2}, 0.3);
  const double dt = stable_step_s(solid);
  Mat3 stretch = Mat3::Zero();
  stretch.diagonal() << 0.05, -0.015, -0.02;
  SolidState state = affine(solid, stretch);
  for (const std::uint32_t s : solid.nodes) {
    state.velocity_m_per_s[0][s] += 0.1;
    state.velocity_m_per_s[1][s] += 5 * (solid.rest_W(s).z() - 0.034);
    state.velocity_m_per_s[2][s] -= 5 * (solid.rest_W(s).y() + 0.016);
  }
  HexScratch scratch;
  const auto momentum = [&] {
    Vec3 sum = Vec3::Zero();
    for (const std::uint32_t s : solid.nodes)
      for (std::size_t k = 0; k < 3; ++k)
        sum[static_cast<Eigen::Index>(k)] += solid.mass_kg[s] * state.velocity_m_per_s[k][s];
    return sum;
  };
  // The energy rises and falls within a swing; its mean over many must not wander.
  const auto mean_energy = [&] {
    double sum = 0;
    for (int n = 0; n < 2000; ++n) {
      step(solid, {}, dt, state, scratch);
      const SolidEnergy e = energy(solid, {}, dt, state, scratch);
      sum += (e.strain_j + e.hourglass_j + e.kinetic_j) / 2000;
    }
    return sum;
  };
  const Vec3 momentum_before = momentum();
  const double before = mean_energy();
  for (int n = 0; n < 96000; ++n) step(solid, {}, dt, state, scratch);
  const double after = mean_energy();
  EXPECT_EQ(state.tick, 100000u);
  EXPECT_LT((momentum() - momentum_before).norm(), 1e-9 * momentum_before.norm());
  EXPECT_NEAR(after / before, 1, 1e-3);
}

// A bar of Poisson 0 that is held at one end swings along itself with the period 4 L / c.
TEST(HexSolid, BarSwingsAlongItselfWithItsPeriod) {
  const HexSolid solid = solid_of({20, 2, 2}, 0);
  Supports supports;
  supports.entries = 1;
  SolidState state = rest_state(solid);
  for (const std::uint32_t s : solid.nodes) {
    const double x = static_cast<double>(solid.place(s)[0]) / 20;
    if (x == 0)
      for (std::uint32_t k = 0; k < 3; ++k) supports.held.push_back({s, k, 0, 0, 0});
    state.velocity_m_per_s[0][s] = 0.01 * std::sin(std::numbers::pi / 2 * x);
  }
  const double dt = stable_step_s(solid), period = 4 * 0.08 / std::sqrt(3000.0 / 1000);
  const std::size_t tip = solid.slot(20, 1, 1);
  HexScratch scratch;
  double last = 0, crossing = 0;
  int crossings = 0;
  for (int n = 1; crossings < 10 && n < 20000; ++n) {
    step(solid, supports, dt, state, scratch);
    const double now = state.moved_m[0][tip];
    if (n > 1 && last * now < 0) {
      ++crossings;
      crossing = (n - 1 + last / (last - now)) * dt;
    }
    last = now;
  }
  EXPECT_NEAR(crossing / 5 / period, 1, 0.02);
}

TEST(HexSolid, FindsWhatIsTurnedInsideOut) {
  const HexSolid solid = solid_of({4, 3, 2});
  SolidState state = rest_state(solid);
  EXPECT_FALSE(find_lost(solid, state));
  const std::size_t corner = solid.slot(4, 3, 2);
  state.moved_m[0][corner] = -0.02;
  auto lost = find_lost(solid, state);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->element, 3u + 4 * (2 + 3 * 1));
  state.moved_m[0][corner] = std::nan("");
  EXPECT_TRUE(find_lost(solid, state));
}

TEST(HexSolid, EmptyCellsDoNothing) {
  HexSolidDef def;
  def.grid.cells = {3, 1, 1};
  def.fill = {1, 0, 1};
  const auto solid = make_hex_solid(def);
  ASSERT_TRUE(solid);
  SolidState state = rest_state(*solid);
  for (std::size_t k = 0; k < 4; ++k)  // the far cell alone moves away
    for (const std::size_t x : {std::size_t{2}, std::size_t{3}})
      state.moved_m[0][solid->slot(x, k % 2, k / 2)] = 0.003;
  HexScratch scratch;
  reckon_forces(*solid, {}, 0, state, scratch);
  for (const auto& axis : scratch.force_n)
    for (const double f : axis) EXPECT_EQ(f, 0);
}

}  // namespace
}  // namespace osteon
