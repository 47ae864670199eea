#include "repair/edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "osteon/base/union_find.h"

namespace osteon {
namespace {

using Uses = std::vector<EdgeUse>;

bool goes_before(const EdgeUse& a, const EdgeUse& b) {
  return std::tie(a.lo, a.hi, a.triangle, a.corner) < std::tie(b.lo, b.hi, b.triangle, b.corner);
}

/// Sorts the uses from one lower vertex, which come in the order of triangles and corners: few.
void sort_few(Uses::iterator first, Uses::iterator last) {
  constexpr std::ptrdiff_t kFew = 64;
  if (last - first > kFew) return std::sort(first, last, goes_before);
  for (auto next = first; next != last; ++next) {
    const EdgeUse use = *next;
    auto place = next;
    for (; place != first && (place - 1)->hi > use.hi; --place) *place = *(place - 1);
    *place = use;
  }
}

/// By counting how many there are at each lower vertex, of `count` vertices.
Uses sorted_by_vertex(const Uses& uses, std::size_t count) {
  std::vector<std::uint32_t> first(count + 1, 0);
  for (const EdgeUse& use : uses) ++first[use.lo + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  Uses sorted(uses.size());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (const EdgeUse& use : uses) sorted[next[use.lo]++] = use;
  for (std::size_t v = 0; v < count; ++v)
    sort_few(sorted.begin() + first[v], sorted.begin() + first[v + 1]);
  return sorted;
}

}  // namespace

std::vector<EdgeUse> edge_uses(const std::vector<Triangle>& triangles) {
  Uses uses;
  uses.reserve(3 * triangles.size());
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t][k];
      const std::uint32_t to = triangles[t][(k + 1u) % 3u];
      uses.push_back({std::min(from, to), std::max(from, to), t, k, from < to});
      count = std::max<std::size_t>(count, std::size_t{uses.back().lo} + 1);
    }
  }
  // Few triangles of a mesh with many vertices are sorted by themselves.
  if (count <= 8 * uses.size()) return sorted_by_vertex(uses, count);
  std::sort(uses.begin(), uses.end(), goes_before);
  return uses;
}

std::vector<std::uint32_t> triangle_components(const std::vector<Triangle>& triangles,
                                               const std::vector<EdgeUse>& uses) {
  UnionFind sets(triangles.size());
  for_each_edge(uses, [&](auto first, auto last) {
    for (auto use = first + 1; use < last; ++use) sets.join(first->triangle, use->triangle);
  });
  std::vector<std::uint32_t> component(triangles.size());
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t r = sets.find(t);
    component[t] = r == t ? count++ : component[r];
  }
  return component;
}

}  // namespace osteon
