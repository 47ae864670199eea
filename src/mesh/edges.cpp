#include "edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace osteon {

std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t][k];
      const std::uint32_t to = triangles[t][(k + 1u) % 3u];
      uses.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.lo, a.hi, a.triangle, a.corner) < std::tie(b.lo, b.hi, b.triangle, b.corner);
  });
  return uses;
}

std::vector<std::uint32_t> triangle_components(const std::vector<Triangle>& triangles,
                                               const std::vector<EdgeUse>& uses) {
  // Union-find whose root is the lowest triangle of its set.
  std::vector<std::uint32_t> parent(triangles.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&parent](std::uint32_t t) {
    while (parent[t] != t) {
      parent[t] = parent[parent[t]];
      t = parent[t];
    }
    return t;
  };
  for_each_edge(uses, [&](auto first, auto last) {
    for (auto use = first + 1; use < last; ++use) {
      const std::uint32_t a = root(first->triangle);
      const std::uint32_t b = root(use->triangle);
      parent[std::max(a, b)] = std::min(a, b);
    }
  });
  std::vector<std::uint32_t> component(triangles.size());
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t r = root(t);
    component[t] = r == t ? count++ : component[r];
  }
  return component;
}

}  // namespace osteon
