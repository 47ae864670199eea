#include "repair/clean.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "repair/edge_counts.h"
#include "repair/edges.h"

namespace osteon {
namespace {

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

// Same way round: a rotation of the same three vertices.
bool same_facing(const Triangle& a, const Triangle& b) {
  const auto at = std::find(b.begin(), b.end(), a[0]) - b.begin();
  return b[static_cast<std::size_t>(at + 1) % 3] == a[1];
}

// A membrane hangs on edges that are whole without it, a fold on edges that nothing else needs. An
// edge of exactly two triangles says that this one is part of a surface.
std::size_t drop_folds(TriMesh& mesh, std::vector<char> two_sided) {
  EdgeCounts counts(mesh);
  std::vector<char> dropped(mesh.triangles.size(), 0);
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!two_sided[t] || dropped[t]) continue;
      const std::array<int, 3> uses = counts.of(mesh.triangles[t]);
      if (std::find(uses.begin(), uses.end(), 2) != uses.end()) continue;
      counts.add(mesh.triangles[t], -1);
      dropped[t] = 1;
      changed = true;
    }
  }
  return erase_marked(mesh, dropped);
}

// Which corner lies between the other two: opposite the longest side.
std::size_t middle_corner(const TriMesh& mesh, const Triangle& t) {
  std::size_t middle = 0;
  double longest = -1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = mesh.vertices[t[(k + 2) % 3]] - mesh.vertices[t[(k + 1) % 3]];
    if (side.squaredNorm() <= longest) continue;
    longest = side.squaredNorm();
    middle = k;
  }
  return middle;
}

struct Use {
  std::uint32_t triangle;
  std::uint8_t corner;
};

std::vector<Use> uses_of(const std::vector<EdgeUse>& uses, std::uint32_t a, std::uint32_t b) {
  const auto [lo, hi] = std::minmax(a, b);
  const auto less = [](const EdgeUse& use, const std::pair<std::uint32_t, std::uint32_t>& edge) {
    return std::pair(use.lo, use.hi) < edge;
  };
  auto at = std::lower_bound(uses.begin(), uses.end(), std::pair(lo, hi), less);
  std::vector<Use> found;
  for (; at != uses.end() && at->lo == lo && at->hi == hi; ++at)
    found.push_back({at->triangle, at->corner});
  return found;
}

// One sweep over the flat triangles. `touched` triangles wait for the next sweep, when the edges
// are known anew.
class FlatSweep {
 public:
  explicit FlatSweep(TriMesh& mesh)
      : mesh_(mesh),
        uses_(edge_uses(mesh.triangles)),
        touched_(mesh.triangles.size(), 0),
        dropped_(mesh.triangles.size(), 0) {}

  std::size_t run() {
    std::size_t mended = 0;
    for (std::uint32_t t = 0; t < touched_.size(); ++t)
      if (!touched_[t] && is_flat_triangle(mesh_.triangles[t])) mended += mend(t);
    erase_marked(mesh_, dropped_);
    return mended;
  }

 private:
  bool is_flat_triangle(const Triangle& t) const {
    return is_flat(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]);
  }

  bool mend(std::uint32_t t) {
    const Triangle flat = mesh_.triangles[t];
    const std::size_t k = middle_corner(mesh_, flat);
    const std::uint32_t b = flat[k];
    const std::vector<Use> around = uses_of(uses_, flat[(k + 1) % 3], flat[(k + 2) % 3]);
    if (around.size() == 1) {
      touched_[t] = dropped_[t] = 1;
      return true;
    }
    if (around.size() != 2) return false;
    const Use other = around[0].triangle == t ? around[1] : around[0];
    return !touched_[other.triangle] && split_neighbour(t, b, other);
  }

  // The neighbour x y d becomes x b d and b y d; the first takes the place of the flat triangle.
  bool split_neighbour(std::uint32_t t, std::uint32_t b, const Use& other) {
    const Triangle u = mesh_.triangles[other.triangle];
    const std::uint32_t x = u[other.corner];
    const std::uint32_t y = u[(other.corner + 1u) % 3];
    const std::uint32_t d = u[(other.corner + 2u) % 3];
    if (d == b || !uses_of(uses_, b, d).empty() || !fresh_.insert_new(b, d)) return false;
    mesh_.triangles[t] = {x, b, d};
    mesh_.triangles[other.triangle] = {b, y, d};
    touched_[t] = touched_[other.triangle] = 1;
    return true;
  }

  // Edges made in this sweep.
  struct FreshEdges {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    bool insert_new(std::uint32_t a, std::uint32_t b) {
      const std::pair<std::uint32_t, std::uint32_t> edge = std::minmax(a, b);
      const auto at = std::lower_bound(edges.begin(), edges.end(), edge);
      if (at != edges.end() && *at == edge) return false;
      edges.insert(at, edge);
      return true;
    }
  };

  TriMesh& mesh_;
  std::vector<EdgeUse> uses_;
  std::vector<char> touched_;
  std::vector<char> dropped_;
  FreshEdges fresh_;
};

}  // namespace

std::size_t erase_marked(TriMesh& mesh, const std::vector<char>& marked) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (!marked[t]) mesh.triangles[kept++] = mesh.triangles[t];
  const std::size_t dropped = mesh.triangles.size() - kept;
  mesh.triangles.resize(kept);
  return dropped;
}

bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() <= 1e-10 * longest;
}

std::size_t drop_collapsed_triangles(TriMesh& mesh) {
  std::vector<char> collapsed(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < collapsed.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    collapsed[i] = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  }
  return erase_marked(mesh, collapsed);
}

std::size_t drop_duplicate_triangles(TriMesh& mesh) {
  std::vector<std::pair<Triangle, std::uint32_t>> order;
  order.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    order.push_back({sorted(mesh.triangles[t]), t});
  std::sort(order.begin(), order.end());

  std::vector<char> repeated(order.size(), 0);
  std::vector<char> two_sided(order.size(), 0);
  std::size_t first = 0;
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (order[i].first != order[first].first) {
      first = i;
      continue;
    }
    const std::uint32_t kept = order[first].second;
    const std::uint32_t copy = order[i].second;
    repeated[copy] = 1;
    if (!same_facing(mesh.triangles[kept], mesh.triangles[copy])) two_sided[kept] = 1;
  }
  std::vector<char> two_sided_kept;
  for (std::size_t t = 0; t < repeated.size(); ++t)
    if (!repeated[t]) two_sided_kept.push_back(two_sided[t]);
  const std::size_t copies = erase_marked(mesh, repeated);
  return copies + drop_folds(mesh, std::move(two_sided_kept));
}

std::size_t mend_flat_triangles(TriMesh& mesh) {
  constexpr int kSweeps = 16;
  std::size_t mended = 0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const std::size_t now = FlatSweep(mesh).run();
    mended += now;
    if (now == 0) break;
  }
  return mended;
}

}  // namespace osteon
