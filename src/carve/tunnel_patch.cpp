#include "tunnel_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace osteon::tunnel {
namespace {

/// Edges that a plane cuts, in order, and the first of their new points, which follow it likewise.
struct CutEdges {
  std::vector<EdgeKey> keys;
  std::uint32_t first_point = 0;

  std::optional<std::uint32_t> point_on(std::uint32_t a, std::uint32_t b) const {
    const EdgeKey key(a, b);
    const auto at = std::lower_bound(keys.begin(), keys.end(), key);
    if (at == keys.end() || *at != key) return std::nullopt;
    return first_point + static_cast<std::uint32_t>(at - keys.begin());
  }
};

double least_distance(const Patch& patch, double z) {
  double least = std::numeric_limits<double>::infinity();
  for (const Facet& f : patch.facets)
    if (f.near)
      for (const std::uint32_t v : f.v)
        least = std::min(least, std::abs(patch.points_A[v].z() - z));
  return least;
}

CutEdges find_cut_edges(const Patch& patch, double z) {
  CutEdges cut;
  for (const Facet& f : patch.facets) {
    if (!f.near) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = f.v[k], b = f.v[(k + 1) % 3];
      if ((patch.points_A[a].z() < z) != (patch.points_A[b].z() < z)) cut.keys.emplace_back(a, b);
    }
  }
  std::sort(cut.keys.begin(), cut.keys.end());
  cut.keys.erase(std::unique(cut.keys.begin(), cut.keys.end()), cut.keys.end());
  cut.first_point = static_cast<std::uint32_t>(patch.points_A.size());
  return cut;
}

void add_points(Patch& patch, const CutEdges& cut, double z) {
  for (const EdgeKey& key : cut.keys) {
    const Vec3 &a = patch.points_A[key.lo], &b = patch.points_A[key.hi];
    Vec3 p = a + (z - a.z()) / (b.z() - a.z()) * (b - a);
    p.z() = z;
    patch.points_A.push_back(p);
  }
}

/// The facet's parts; its edge k has the new point mid[k].
void subdivide(const Facet& f, const std::array<std::optional<std::uint32_t>, 3>& mid,
               std::vector<Facet>& out) {
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out.push_back({{a, b, c}, f.near, f.layer});
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = f.v[k], b = f.v[(k + 1) % 3], c = f.v[(k + 2) % 3];
    if (mid[k] && mid[(k + 2) % 3]) {  // a stands alone on its side
      add(a, *mid[k], *mid[(k + 2) % 3]);
      add(*mid[k], b, c);
      add(*mid[k], c, *mid[(k + 2) % 3]);
      return;
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (!mid[k]) continue;
    add(f.v[k], *mid[k], f.v[(k + 2) % 3]);
    add(*mid[k], f.v[(k + 1) % 3], f.v[(k + 2) % 3]);
    return;
  }
  out.push_back(f);
}

}  // namespace

double split_at(Patch& patch, double z_m) {
  const double least = least_distance(patch, z_m);
  const CutEdges cut = find_cut_edges(patch, z_m);
  if (cut.keys.empty()) return least;
  add_points(patch, cut, z_m);
  std::vector<Facet> facets;
  facets.reserve(patch.facets.size() + 3 * cut.keys.size());
  for (const Facet& f : patch.facets)
    subdivide(
        f,
        {cut.point_on(f.v[0], f.v[1]), cut.point_on(f.v[1], f.v[2]), cut.point_on(f.v[2], f.v[0])},
        facets);
  patch.facets = std::move(facets);
  return least;
}

void sort_into_layers(Patch& patch, double start_m, double end_m) {
  for (Facet& f : patch.facets) {
    const double z0 = patch.points_A[f.v[0]].z(), z1 = patch.points_A[f.v[1]].z(),
                 z2 = patch.points_A[f.v[2]].z();
    f.layer = std::max({z0, z1, z2}) <= start_m ? Layer::kBefore
              : std::min({z0, z1, z2}) >= end_m ? Layer::kBeyond
                                                : Layer::kWithin;
  }
}

}  // namespace osteon::tunnel
