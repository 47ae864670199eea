// Bullet's deformable body in single precision, for tissue_bench: a program of its own.
#include "bullet_box.h"

namespace {

void bullet_single_explicit_tetrahedra(benchmark::State& state) {
  osteon::bench::bullet_deformable(state, false);
}
void bullet_single_implicit_tetrahedra(benchmark::State& state) {
  osteon::bench::bullet_deformable(state, true);
}

static_assert(sizeof(btScalar) == sizeof(float));
BENCHMARK(bullet_single_explicit_tetrahedra)->Arg(5)->Arg(16)->Unit(benchmark::kMicrosecond);
BENCHMARK(bullet_single_implicit_tetrahedra)->Arg(5)->Unit(benchmark::kMicrosecond);

}  // namespace
