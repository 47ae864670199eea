// Soft bodies: what a step of an element costs, beside Bullet's deformable body on the same box of
// tissue (six tetrahedra a cube, neo-Hookean, explicit and implicit, without contact) in the same
// run.
//   element_steps_per_s   elements times steps a second, one core
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "bullet_box.h"
#include "osteon/tissue/hex_solid.h"
#include "osteon/tissue/rod.h"
#include "osteon/tissue/tet_solid.h"
#include "tet/tet_explicit.h"

namespace {

using namespace osteon;

using bench::count;
using bench::kFat;

HexGrid box(std::int64_t cells) { return bench::tissue_box(cells); }

// One face held, gravity on, already bent.
void hexahedra(benchmark::State& state) {
  HexSolidDef def;
  def.grid = box(state.range(0));
  def.material = kFat;
  const auto made = make_hex_solid(def);
  if (!made) throw std::runtime_error(made.error().message());
  const HexSolid& solid = *made;
  Supports supports;
  supports.gravity_m_per_s2 = {0, 0, -9.81};
  supports.entries = 1;
  for (const std::uint32_t s : solid.nodes)
    if (solid.place(s)[0] == 0)
      for (std::uint32_t k = 0; k < 3; ++k) supports.held.push_back({s, k, 0, 0, 0});
  SolidState at = rest_state(solid);
  HexScratch scratch;
  const double dt = stable_step_s(solid);
  for (int n = 0; n < 50; ++n) step(solid, supports, dt, at, scratch);
  for (auto _ : state) step(solid, supports, dt, at, scratch);
  count(state, solid.elements);
}

// Some points held where they are, and the rest's weight.
Supports under_weight(const std::vector<bool>& held) {
  Supports supports;
  supports.gravity_m_per_s2 = {0, 0, -9.81};
  supports.entries = 1;
  for (std::uint32_t i = 0; i < held.size(); ++i)
    for (std::uint32_t k = 0; k < 3; ++k)
      if (held[i]) supports.held.push_back({i, k, 0, 0, 0});
  return supports;
}

// An implicit step of a corotated mesh of linear tetrahedra that bends under its weight: its first
// tenth of a second over and over, so that what is measured does not depend on how long.
void step_corotated(benchmark::State& state, TetMesh mesh, const SolidMaterial& material,
                    const std::vector<bool>& held) {
  TetSolidDef def;
  def.mesh = std::move(mesh);
  def.material = material;
  def.order = TetOrder::kLinear;
  def.corotated = true;
  const auto made = make_tet_solid(def);
  if (!made) throw std::runtime_error(made.error().message());
  const Supports supports = under_weight(held);
  const TetStepper stepper(*made, supports, 0.002);
  constexpr std::uint64_t kSteps = 50;
  const SolidState rest = stepper.rest_state();
  SolidState at = rest;
  for (auto _ : state) {
    if (at.tick == kSteps) at = rest;
    if (!stepper.step(at)) throw std::runtime_error("no balance");
  }
  count(state, made->elements.size());
}

std::vector<bool> held_ends(const TetMesh& mesh, double end_m) {
  std::vector<bool> held;
  for (const Vec3& p : mesh.vertices) held.push_back(p.x() < 1e-9 || p.x() > end_m - 1e-9);
  return held;
}

// Held at one end.
void corotated_tetrahedra(benchmark::State& state) {
  const TetMesh mesh = split_into_tetrahedra(box(state.range(0)));
  step_corotated(state, mesh, {1e6, 0.45, 1100, 5}, held_ends(mesh, 1));
}

// A meniscus of 2016 tetrahedra: half a ring, 9 mm wide and 6 mm high, held at both horns.
void implicit_meniscus(benchmark::State& state) {
  constexpr double kPi = 3.14159265358979323846, kCell_m = 0.0015, kLength_m = 14 * kCell_m;
  TetMesh mesh = split_into_tetrahedra({{14, 6, 4}, kCell_m, Vec3::Zero()});
  const std::vector<bool> horns = held_ends(mesh, kLength_m);
  for (Vec3& p : mesh.vertices) {
    const double turn = kPi * p.x() / kLength_m, radius = 0.015 + p.y();
    p = {-radius * std::cos(turn), radius * std::sin(turn), p.z()};
  }
  step_corotated(state, std::move(mesh), {20e6, 0.45, 1100, 5}, horns);
}

// Explicit steps of neo-Hookean linear tetrahedra, held at one face.
void explicit_tetrahedra(benchmark::State& state) {
  TetSolidDef def;
  def.mesh = split_into_tetrahedra(box(state.range(0)));
  def.material = kFat;
  def.order = TetOrder::kLinear;
  const auto made = make_tet_solid(def);
  if (!made) throw std::runtime_error(made.error().message());
  const Supports supports = under_weight(held_ends(def.mesh, 1));
  SolidState at = state_at_rest(made->rest_W.size(), false);
  TetScratch scratch;
  const double dt = stable_explicit_step_s(*made);
  for (int n = 0; n < 50; ++n) explicit_step(*made, supports, dt, at, scratch);
  for (auto _ : state) explicit_step(*made, supports, dt, at, scratch);
  count(state, made->elements.size());
}

// A tendon of 100 segments, held at one end, that falls and swings under its weight: two seconds of
// it, over and over, so that what is measured does not depend on how long. From the start, where it
// is so quick that a step has parts, or from two seconds later.
void rod_of_100_segments(benchmark::State& state) {
  constexpr std::uint64_t kSteps = 2000;
  RodDef def;
  def.points_W = {Vec3::Zero(), {0.2, 0, 0}};
  def.segments = 100;
  def.material = {1e8, 0.3, 1100, 5};
  auto made = make_rod(def);
  if (!made) throw std::runtime_error(made.error().message());
  RodSupports supports;
  supports.gravity_m_per_s2 = {0, 0, -9.81};
  supports.grips.emplace_back();
  for (std::uint32_t k = 0; k < 3; ++k) supports.axes.push_back({0, k, 0});
  RodStepper stepper(std::move(*made), supports, 0.001);
  RodState start = stepper.start_state();
  while (start.tick < kSteps * static_cast<std::uint64_t>(state.range(0))) stepper.step(start);
  RodState at = start;
  for (auto _ : state) {
    if (at.tick == start.tick + kSteps) at = start;
    stepper.step(at);
  }
  count(state, 100);
}

void bullet_explicit_tetrahedra(benchmark::State& state) { bench::bullet_deformable(state, false); }
void bullet_implicit_tetrahedra(benchmark::State& state) { bench::bullet_deformable(state, true); }

BENCHMARK(hexahedra)->Arg(8)->Arg(16)->Arg(22)->Unit(benchmark::kMicrosecond);
BENCHMARK(corotated_tetrahedra)->Arg(5)->Unit(benchmark::kMicrosecond);
BENCHMARK(explicit_tetrahedra)->Arg(5)->Arg(8)->Arg(16)->Unit(benchmark::kMicrosecond);
BENCHMARK(implicit_meniscus)->Unit(benchmark::kMicrosecond);
BENCHMARK(rod_of_100_segments)->ArgName("later")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);
BENCHMARK(bullet_explicit_tetrahedra)->Arg(5)->Arg(16)->Unit(benchmark::kMicrosecond);
BENCHMARK(bullet_implicit_tetrahedra)->Arg(5)->Unit(benchmark::kMicrosecond);

}  // namespace
