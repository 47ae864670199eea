#include "instrument/swept_tube.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "instrument/loop_stack.h"

namespace osteon {
namespace {

// From `side` to `along x side` it runs counter-clockwise seen against `along`.
Loop loop_of(const TubeRing& ring, int segments) {
  const Vec3 side = Vec3::UnitY();
  const Vec3 up = ring.along.cross(side);
  Loop loop;
  for (int i = 0; i < segments; ++i) {
    const double a = 2 * std::numbers::pi * i / segments;
    loop.push_back(ring.center + ring.radius_m * (std::cos(a) * side + std::sin(a) * up));
  }
  return loop;
}

}  // namespace

TriMesh sweep_tube(const Vec3& first_point, const std::vector<TubeRing>& rings,
                   const Vec3& last_point, int segments) {
  assert(!rings.empty() && segments >= 3);
  std::vector<Loop> loops;
  for (const TubeRing& ring : rings) loops.push_back(loop_of(ring, segments));
  return stack_loops(first_point, loops, last_point);
}

}  // namespace osteon
