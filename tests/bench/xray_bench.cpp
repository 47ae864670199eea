// A shot of the C-arm at the built-in knee with all its soft parts: projection through every
// surface, spectrum, noise, blur and brightness. On all cores, as the program takes it.
#include <benchmark/benchmark.h>

#include "runs/pictures/xray_shot.h"

namespace {

using namespace osteon;

const XrayScene& scene() {
  static const XrayScene made = *open_xray_scene({"builtin:knee", {}, {}, {}});
  return made;
}

void shot(benchmark::State& state, double orbit_rad) {
  XrayShotOrder order;
  order.arm.width_px = order.arm.height_px = static_cast<int>(state.range(0));
  order.arm.orbit_rad = orbit_rad;
  order.arm.isocenter_W = scene().isocenter_W;
  for (auto _ : state) {
    auto taken = take_shot(scene(), order);
    benchmark::DoNotOptimize(taken);
  }
}

void xray_shot_ap(benchmark::State& state) { shot(state, 0); }
void xray_shot_lateral(benchmark::State& state) { shot(state, 1.5707963); }

void xray_density_alone(benchmark::State& state) {
  CArm arm;
  arm.width_px = arm.height_px = static_cast<int>(state.range(0));
  arm.isocenter_W = scene().isocenter_W;
  const XrayView view = *xray_view(arm, scene().patient);
  for (auto _ : state) {
    auto density = areal_density(scene().body, view);
    benchmark::DoNotOptimize(density);
  }
}

BENCHMARK(xray_shot_ap)->Arg(512)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(xray_shot_lateral)->Arg(512)->Arg(256)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(xray_density_alone)->Arg(512)->Unit(benchmark::kMillisecond);

}  // namespace
