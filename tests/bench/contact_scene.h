#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "osteon/base/turn.h"
#include "osteon/collide/convex_body.h"
#include "osteon/hull/hull.h"

namespace osteon::bench {

inline const Vec3 kBoneHalf(0.010, 0.015, 0.030);
inline constexpr double kProbeHalf = 0.006;

/// Corners spread evenly over an ellipsoid (golden spiral), each a corner of the hull.
inline Hull ellipsoid(int corners, const Vec3& half) {
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    const double z = 1 - (2 * i + 1.0) / corners;
    const double r = std::sqrt(1 - z * z);
    const double angle = i * M_PI * (3 - std::sqrt(5.0));
    points.push_back(Vec3(r * std::cos(angle), r * std::sin(angle), z).cwiseProduct(half));
  }
  return *osteon::build_hull(points).hull;
}

/// A 700-corner bone and a 32-corner probe, and the poses of the probe that every query gets.
struct Scene {
  Hull bone = ellipsoid(700, kBoneHalf);
  Hull probe = ellipsoid(32, {0.0015, 0.0015, kProbeHalf});
  ConvexBody bone_body = make_convex_body(bone);
  ConvexBody probe_body = make_convex_body(probe);
  std::vector<Pose> path;

  Scene() {
    // 60 s at 1 kHz: a stroke round the bone, the probe upright, 0.5 mm deep to 0.1 mm off.
    for (int i = 0; i < 60000; ++i) {
      const double s = i * 1e-3;
      const double c = std::cos(0.13 * s);
      const Vec3 u(c * std::cos(0.3 * s), c * std::sin(0.3 * s), std::sin(0.13 * s));
      const Vec3 n = u.cwiseQuotient(kBoneHalf).normalized();
      const double depth = 0.0002 + 0.0003 * std::sin(2 * s);
      const Quat q = turn_between(Vec3::UnitZ(), n);
      path.push_back({u.cwiseProduct(kBoneHalf) + (kProbeHalf - depth) * n, q});
    }
  }
};

inline const Scene& scene() {
  static const Scene s;
  return s;
}

/// Runs `query(pose) -> hit` along the path and reports the share of hits.
template <class Query>
void along_path(benchmark::State& state, const Query& query) {
  const Scene& s = scene();
  std::size_t i = 0, hits = 0, done = 0;
  for (auto _ : state) {
    hits += query(s.path[i]) ? 1 : 0;
    ++done;
    i = i + 1 == s.path.size() ? 0 : i + 1;
  }
  state.counters["hit_share"] = static_cast<double>(hits) / static_cast<double>(done);
}

}  // namespace osteon::bench
