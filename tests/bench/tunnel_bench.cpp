// A tunnel of 9 mm through the built-in femur: fixing its line, and an advance of the drill, which
// a picture waits for.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <stdexcept>

#include "osteon/anatomy/generate.h"
#include "osteon/carve/tunnel.h"

namespace {

using namespace osteon;

const TriMesh& femur() {
  static const TriMesh mesh = [] {
    GenerateOptions options;
    options.soft_parts = false;
    const auto knee = generate_anatomy(
        std::filesystem::path(OSTEON_SOURCE_DIR) / "assets/anatomy/knee.toml", options);
    if (!knee) throw std::runtime_error(knee.error().message());
    for (const GeneratedBone& bone : knee->bones)
      if (bone.name == "femur") return bone.mesh;
    throw std::runtime_error("the knee has no femur");
  }();
  return mesh;
}

TunnelLine line() { return {Vec3(-0.04, -0.06, 0.01), Vec3(0.01, 0, 0), 0.009}; }

void BM_PlanTunnel(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(plan_tunnel(femur(), line()));
}
BENCHMARK(BM_PlanTunnel)->Unit(benchmark::kMillisecond);

void BM_AdvanceTunnel(benchmark::State& state) {
  const auto plan = plan_tunnel(femur(), line());
  if (!plan) throw std::runtime_error(plan.error().message());
  double depth_m = 0.026;
  for (auto _ : state) {
    benchmark::DoNotOptimize(advance(*plan, depth_m));
    depth_m = depth_m > 0.06 ? 0.026 : depth_m + 0.1e-3;
  }
}
BENCHMARK(BM_AdvanceTunnel)->Unit(benchmark::kMillisecond);

}  // namespace
