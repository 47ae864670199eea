// A moving scope's picture, 720 x 720, in the notch of the built-in knee: in clear and cloudy
// water, with blood and plumes, with a fogged lens, with all of that and bubbles; from the surfaces
// that a window shares with it, in as many pixels as there. Needs OpenGL, without a window.
#include <benchmark/benchmark.h>
#include <epoxy/gl.h>

#include <chrono>
#include <span>
#include <stdexcept>
#include <vector>

#include "cases/standard_views.h"
#include "osteon/render/joint_room.h"
#include "osteon/render/prepare.h"
#include "osteon/render/renderer.h"
#include "osteon/render/scope_renderer.h"
#include "osteon/scene/scope.h"
#include "osteon/scene/tool.h"

namespace osteon {
namespace {

template <class T>
T made(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message());
  return std::move(*result);
}

struct NotchPicture {
  OffscreenContext context = made(OffscreenContext::create());
  Case knee = made(open_scoped_case("builtin:knee", 80));
  ScopeDef scope = made(load_scope("knee_30"));
  /// The window's: the scope shares its surfaces and, where a processor draws, has fewer pixels.
  Renderer scene =
      made(Renderer::create(knee, make_wrist_probe(), OSTEON_SOURCE_DIR, prepare_case(knee)));
  ScopeRenderer renderer = made(ScopeRenderer::create(knee, OSTEON_SOURCE_DIR, scene));

  NotchPicture() {
    const auto wall = JointRoom(knee).wall(rest_snapshot(knee), Vec3(0.010, -0.010, -0.004));
    if (wall) renderer.set_wall(*wall);
  }
  ScopePose pose(double along_m) const {
    ScopePose pose;
    pose.at_W = Vec3(0.010, -0.010 + along_m, -0.004);
    pose.toward_W = Vec3(-0.014, -0.002, -0.012);
    pose.post_rad = 1.5707963267948966;
    pose.up_W = Vec3::UnitZ();
    return pose;
  }
};

NotchPicture& the_notch() {
  static NotchPicture notch;
  return notch;
}

/// From nothing but what a window has already: the programs are compiled and the first picture is
/// drawn, then the first of cloudy water. `rest`: before that it stands still for as many pictures.
/// MESA_SHADER_CACHE_DISABLE=true: none is found on the
/// disk.
void first_scope_picture(benchmark::State& state, int rest) {
  NotchPicture& notch = the_notch();
  const auto wall = JointRoom(notch.knee).wall(rest_snapshot(notch.knee), notch.pose(0).at_W);
  const auto paint = [&](ScopeRenderer& scope) {
    const auto from = std::chrono::steady_clock::now();
    (void)scope.paint(ScopeCamera(notch.scope, notch.pose(0)), 720);
    glFinish();
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - from;
    return took.count();
  };
  for (auto _ : state) {
    const auto from = std::chrono::steady_clock::now();
    ScopeRenderer scope = made(ScopeRenderer::create(notch.knee, OSTEON_SOURCE_DIR, notch.scene));
    glFinish();
    const std::chrono::duration<double, std::milli> made_in =
        std::chrono::steady_clock::now() - from;
    state.counters["made_ms"] = made_in.count();
    if (wall) scope.set_wall(*wall);
    state.counters["first_ms"] = paint(scope);
    state.counters["second_ms"] = paint(scope);
    for (int k = 0; k < rest; ++k) (void)paint(scope);
    scope.set_water({60, 0.2, 0});
    state.counters["first_cloudy_ms"] = paint(scope);
    state.counters["second_cloudy_ms"] = paint(scope);
  }
}

void scope_picture(benchmark::State& state, const ScopeWater& water,
                   std::span<const WaterBit> bits = {}) {
  NotchPicture& notch = the_notch();
  notch.renderer.set_water(water);
  notch.renderer.set_water_bits(bits);
  double along_m = 0;
  for (auto _ : state) {
    along_m = along_m > 0.002 ? 0 : along_m + 1e-4;
    (void)notch.renderer.paint(ScopeCamera(notch.scope, notch.pose(along_m)), 720);
    glFinish();
  }
}

ScopeWater plumes() {
  ScopeWater water{60, 0.5, 0};
  water.plume_count = 2;
  water.plumes[0] = {Vec3(-0.014, -0.002, -0.012), 0.005, 60};
  water.plumes[1] = {Vec3(-0.010, -0.006, -0.010), 0.003, 60};
  return water;
}

ScopeWater everything() {
  ScopeWater water = plumes();
  water.fog = 0.4;
  return water;
}

/// Before the lens, strewn by steps that do not fall together.
std::vector<WaterBit> bubbles_and_flakes() {
  std::vector<WaterBit> bits;
  for (int k = 0; k < 42; ++k) {
    WaterBit bit;
    bit.p_W = Vec3(-0.004 - 3e-4 * k, -0.006 + 2e-4 * (7 * k % 42), -0.008 + 2e-4 * (11 * k % 42));
    bit.radius_m = 6e-4;
    bit.is = k < 30 ? WaterBit::Is::kBubble : WaterBit::Is::kFlake;
    bit.shape = k / 42.0;
    bits.push_back(bit);
  }
  return bits;
}

BENCHMARK_CAPTURE(first_scope_picture, at_once, 0)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK_CAPTURE(first_scope_picture, after_a_rest, 40)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK_CAPTURE(scope_picture, clear, ScopeWater{})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scope_picture, cloudy, ScopeWater{60, 0, 0})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scope_picture, blood_and_two_plumes, plumes())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scope_picture, fogged, ScopeWater{0, 0, 0.4})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(scope_picture, all_with_bubbles, everything(), bubbles_and_flakes())
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace osteon
