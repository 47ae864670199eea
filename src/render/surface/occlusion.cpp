#include "surface/occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "surface/ray_bvh.h"

namespace osteon {
namespace {

constexpr int kDirections = 64;
constexpr float kUnknown = -1;

/// Spherical Fibonacci points (Keinert et al. 2015): the same even set for every vertex, so that
/// neighbours differ by what they see and not by noise.
std::vector<Vec3> even_directions() {
  std::vector<Vec3> directions;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int k = 0; k < kDirections; ++k) {
    const double z = 1 - (2 * k + 1.0) / kDirections;
    const double r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(golden * k), r * std::sin(golden * k), z);
  }
  return directions;
}

void append(const std::vector<PlacedSurface>& surfaces, TriMesh& all) {
  for (const PlacedSurface& placed : surfaces) {
    const auto base = static_cast<std::uint32_t>(all.vertices.size());
    for (const Vec3& p_B : placed.surface.points) all.vertices.push_back(placed.X_WB * p_B);
    for (const Triangle& t : placed.surface.triangles)
      all.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
}

float openness(const RayBvh& bvh, const std::vector<Vec3>& directions, const Vec3& p_W,
               const Vec3& nhat_W, double reach_m) {
  const Vec3 start = p_W + nhat_W * (reach_m * 0.004);  // clear of its own triangles
  double weight = 0, hidden = 0;
  for (const Vec3& d : directions) {
    const double cosine = nhat_W.dot(d);
    if (cosine < 0.05) continue;
    weight += cosine;
    if (const auto hit = bvh.closest(start, d, reach_m)) hidden += cosine * (1 - hit->t / reach_m);
  }
  return weight > 0 ? static_cast<float>(1 - hidden / weight) : 1.0f;
}

/// Gives vertices that were not sampled the mean of their known neighbours, ring by ring.
void fill_unknown(const Surface& s, std::vector<float>& values) {
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<float> next = values;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (values[k] != kUnknown) continue;
      float sum = 0;
      int known = 0;
      for (std::uint32_t e = s.first[k]; e < s.first[k + 1]; ++e) {
        const float v = values[s.neighbours[e]];
        if (v == kUnknown) continue;
        sum += v;
        ++known;
      }
      if (known == 0) continue;
      next[k] = sum / static_cast<float>(known);
      changed = true;
    }
    values.swap(next);
  }
  std::replace(values.begin(), values.end(), kUnknown, 1.0f);
}

}  // namespace

std::vector<std::vector<float>> sky_openness(const std::vector<PlacedSurface>& surfaces,
                                             const std::vector<PlacedSurface>& others,
                                             double reach_m, std::size_t rays,
                                             const std::function<bool(double)>& progress) {
  std::size_t total = 0;
  for (const PlacedSurface& placed : surfaces) total += placed.surface.points.size();
  const std::size_t stride = 1 + total * kDirections / 2 / rays;
  TriMesh all;
  append(surfaces, all);
  append(others, all);
  const RayBvh bvh(all.vertices, all.triangles);
  const std::vector<Vec3> directions = even_directions();

  std::vector<std::vector<float>> out;
  std::size_t done = 0;
  bool stopped = false;
  for (const auto& [surface, X_WB] : surfaces) {
    std::vector<float> values(surface.points.size(), kUnknown);
    for (std::size_t k = 0; k < values.size() && !stopped; ++k, ++done) {
      if (k % stride == 0)
        values[k] = openness(bvh, directions, X_WB * surface.points[k],
                             X_WB.rotate(surface.normals[k]), reach_m);
      if (done % 1024 == 0 && progress)
        stopped = !progress(static_cast<double>(done) / static_cast<double>(total));
    }
    if (!stopped) {
      fill_unknown(surface, values);
      smooth(surface, 2, values);
    }
    std::replace(values.begin(), values.end(), kUnknown, 1.0f);
    out.push_back(std::move(values));
  }
  return out;
}

}  // namespace osteon
