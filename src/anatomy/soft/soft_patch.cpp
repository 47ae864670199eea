#include "soft/soft_patch.h"

#include <algorithm>
#include <map>
#include <utility>

#include "osteon/base/union_find.h"

namespace osteon {
namespace {

constexpr double kSnap = 0.2;  // of an edge: a cut nearer to its end goes through the end

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge sorted(std::uint32_t a, std::uint32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// The place on the edge from u to v where `inside` is 0.
CoveredVertex crossing_of(const CoveredVertex& u, const CoveredVertex& v) {
  const double share = u.inside / (u.inside - v.inside);
  CoveredVertex rim;
  rim.p = u.p + share * (v.p - u.p);
  rim.normal = (u.normal + share * (v.normal - u.normal)).normalized();
  rim.height = u.height + share * (v.height - u.height);
  return rim;
}

/// Moves vertices that the rim nearly meets onto it, along the edge where it is nearest, so that no
/// sliver is cut off.
void snap(CoveredPatch& patch) {
  std::vector<double> nearest(patch.vertices.size(), kSnap);
  std::vector<CoveredVertex> snapped = patch.vertices;
  const auto look = [&](std::uint32_t i, std::uint32_t j) {
    const CoveredVertex &u = patch.vertices[i], &v = patch.vertices[j];
    if ((u.inside > 0) == (v.inside > 0) || u.inside == v.inside) return;
    const double share = u.inside / (u.inside - v.inside);
    if (share >= nearest[i]) return;
    nearest[i] = share;
    snapped[i] = crossing_of(u, v);
  };
  for (const Triangle& t : patch.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      look(t[k], t[(k + 1) % 3]);
      look(t[(k + 1) % 3], t[k]);
    }
  patch.vertices = std::move(snapped);
}

class RimCutter {
 public:
  explicit RimCutter(CoveredPatch patch) : patch_(std::move(patch)) {
    snap(patch_);
    const std::vector<Triangle> all = std::move(patch_.triangles);
    patch_.triangles.clear();
    for (const Triangle& t : all) cut(t);
  }
  CoveredPatch take() { return std::move(patch_); }

 private:
  double inside(std::uint32_t v) const { return patch_.vertices[v].inside; }

  /// Keeps the corners inside and the crossings of the edges between inside and outside.
  void cut(const Triangle& t) {
    if (std::max({inside(t[0]), inside(t[1]), inside(t[2])}) <= 0) return;
    std::vector<std::uint32_t> kept;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (inside(a) >= 0) kept.push_back(a);
      if ((inside(a) > 0 && inside(b) < 0) || (inside(a) < 0 && inside(b) > 0))
        kept.push_back(crossing(a, b));
    }
    for (std::size_t k = 2; k < kept.size(); ++k)
      patch_.triangles.push_back({kept[0], kept[k - 1], kept[k]});
  }

  std::uint32_t crossing(std::uint32_t a, std::uint32_t b) {
    const Edge edge = sorted(a, b);
    const auto [at, made] = made_.try_emplace(edge, 0);
    if (!made) return at->second;
    const CoveredVertex rim =
        crossing_of(patch_.vertices[edge.first], patch_.vertices[edge.second]);
    patch_.vertices.push_back(rim);
    return at->second = static_cast<std::uint32_t>(patch_.vertices.size() - 1);
  }

  CoveredPatch patch_;
  std::map<Edge, std::uint32_t> made_;
};

double area_of(const CoveredPatch& patch, const Triangle& t) {
  const Vec3& a = patch.vertices[t[0]].p;
  return 0.5 * (patch.vertices[t[1]].p - a).cross(patch.vertices[t[2]].p - a).norm();
}

/// Triangles that share an edge belong together.
UnionFind pieces_of(const CoveredPatch& patch) {
  UnionFind pieces(patch.triangles.size());
  std::map<Edge, std::uint32_t> seen;
  for (std::uint32_t i = 0; i < patch.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& t = patch.triangles[i];
      const auto [at, first] = seen.try_emplace(sorted(t[k], t[(k + 1) % 3]), i);
      if (!first) pieces.join(at->second, i);
    }
  return pieces;
}

void drop_small(CoveredPatch& patch, double least_area_m2) {
  UnionFind pieces = pieces_of(patch);
  std::vector<double> area(patch.triangles.size(), 0);
  for (std::uint32_t i = 0; i < patch.triangles.size(); ++i)
    area[pieces.find(i)] += area_of(patch, patch.triangles[i]);
  std::vector<Triangle> kept;
  for (std::uint32_t i = 0; i < patch.triangles.size(); ++i)
    if (area[pieces.find(i)] >= least_area_m2) kept.push_back(patch.triangles[i]);
  patch.triangles = std::move(kept);
}

/// The fans of triangles about a vertex: each a list of triangles.
std::vector<std::vector<std::size_t>> fans_at(std::uint32_t v,
                                              const std::vector<std::size_t>& around,
                                              const CoveredPatch& patch) {
  UnionFind groups(around.size());
  std::map<std::uint32_t, std::uint32_t> spoke;  // the other end of an edge at v
  for (std::uint32_t k = 0; k < around.size(); ++k)
    for (const std::uint32_t other : patch.triangles[around[k]]) {
      if (other == v) continue;
      const auto [at, first] = spoke.try_emplace(other, k);
      if (!first) groups.join(at->second, k);
    }
  std::map<std::uint32_t, std::vector<std::size_t>> by_group;
  for (std::uint32_t k = 0; k < around.size(); ++k) by_group[groups.find(k)].push_back(around[k]);
  std::vector<std::vector<std::size_t>> fans;
  for (auto& [group, fan] : by_group) fans.push_back(std::move(fan));
  return fans;
}

/// One vertex for each fan of triangles; where there are several, each is drawn back a little into
/// its own fan, so that what reads the places of vertices alone keeps them apart too.
CoveredPatch part_fans(const CoveredPatch& patch) {
  constexpr double kDrawnBack = 0.05;  // of the way to the middle of the fan
  std::vector<std::vector<std::size_t>> around(patch.vertices.size());
  for (std::size_t i = 0; i < patch.triangles.size(); ++i)
    for (const std::uint32_t v : patch.triangles[i]) around[v].push_back(i);
  CoveredPatch parted;
  parted.triangles = patch.triangles;
  for (std::uint32_t v = 0; v < around.size(); ++v) {
    const auto fans = fans_at(v, around[v], patch);
    for (const std::vector<std::size_t>& fan : fans) {
      Vec3 middle = Vec3::Zero();
      for (const std::size_t t : fan) {
        for (std::size_t c = 0; c < 3; ++c) {
          middle +=
              patch.vertices[patch.triangles[t][c]].p / (3.0 * static_cast<double>(fan.size()));
          if (patch.triangles[t][c] == v)
            parted.triangles[t][c] = static_cast<std::uint32_t>(parted.vertices.size());
        }
      }
      parted.vertices.push_back(patch.vertices[v]);
      if (fans.size() > 1) parted.vertices.back().p += kDrawnBack * (middle - patch.vertices[v].p);
    }
  }
  return parted;
}

}  // namespace

CoveredPatch cut_patch(const CoveredPatch& whole, double least_area_m2) {
  CoveredPatch patch = RimCutter(whole).take();
  drop_small(patch, least_area_m2);
  return patch;
}

TriMesh raise_patch(const CoveredPatch& patch) {
  const CoveredPatch base = part_fans(patch);
  TriMesh shell;
  const auto count = static_cast<std::uint32_t>(base.vertices.size());
  for (const CoveredVertex& v : base.vertices) shell.vertices.push_back(v.p);
  for (const CoveredVertex& v : base.vertices) shell.vertices.push_back(v.p + v.height * v.normal);
  std::map<Edge, int> uses;
  for (const Triangle& t : base.triangles) {
    shell.triangles.push_back({t[0], t[2], t[1]});
    shell.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    for (std::size_t k = 0; k < 3; ++k) ++uses[sorted(t[k], t[(k + 1) % 3])];
  }
  for (const Triangle& t : base.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (uses[sorted(a, b)] != 1) continue;
      shell.triangles.push_back({a, b, b + count});
      shell.triangles.push_back({a, b + count, a + count});
    }
  return shell;
}

}  // namespace osteon
