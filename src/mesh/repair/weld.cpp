#include "repair/weld.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "osteon/mesh/repair.h"

namespace osteon {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

struct Cell {
  std::int64_t x = 0, y = 0, z = 0;
  bool operator==(const Cell&) const = default;
};

struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = static_cast<std::uint64_t>(c.x) * 0x9e3779b97f4a7c15ull;
    h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(c.y)) * 0xbf58476d1ce4e5b9ull;
    h = (h ^ (h >> 32) ^ static_cast<std::uint64_t>(c.z)) * 0x94d049bb133111ebull;
    return static_cast<std::size_t>(h ^ (h >> 31));
  }
};

// Vertices that stay, found by place. The map is only looked up, never walked: its order is not
// defined.
class Places {
 public:
  Places(const std::vector<Vec3>& vertices, double distance)
      : vertices_(vertices), distance_(distance), next_(vertices.size(), kNoVertex) {
    newest_.reserve(vertices.size());
  }

  // The earliest vertex within reach of `p`, or kNoVertex.
  std::uint32_t find(const Vec3& p) const {
    std::uint32_t best = kNoVertex;
    const Cell c = cell_of(p);
    const std::int64_t reach = distance_ > 0 ? 1 : 0;
    for (std::int64_t dx = -reach; dx <= reach; ++dx)
      for (std::int64_t dy = -reach; dy <= reach; ++dy)
        for (std::int64_t dz = -reach; dz <= reach; ++dz)
          best = std::min(best, find_in({c.x + dx, c.y + dy, c.z + dz}, p));
    return best;
  }

  void add(std::uint32_t v) {
    const auto [at, is_new] = newest_.try_emplace(cell_of(vertices_[v]), v);
    if (is_new) return;
    next_[v] = at->second;
    at->second = v;
  }

 private:
  Cell cell_of(const Vec3& p) const {
    const auto index = [this](double x) {
      // Without a distance, a cell for every value; + 0.0 makes one of the two zeros.
      return distance_ > 0 ? static_cast<std::int64_t>(std::floor(x / distance_))
                           : std::bit_cast<std::int64_t>(x + 0.0);
    };
    return {index(p.x()), index(p.y()), index(p.z())};
  }

  std::uint32_t find_in(const Cell& cell, const Vec3& p) const {
    std::uint32_t best = kNoVertex;
    const auto at = newest_.find(cell);
    if (at == newest_.end()) return best;
    for (std::uint32_t v = at->second; v != kNoVertex; v = next_[v])
      if ((vertices_[v] - p).squaredNorm() <= distance_ * distance_) best = std::min(best, v);
    return best;
  }

  const std::vector<Vec3>& vertices_;
  double distance_;
  std::unordered_map<Cell, std::uint32_t, CellHash> newest_;
  std::vector<std::uint32_t> next_;  ///< the vertex added before in the same cell
};

}  // namespace

std::size_t drop_unused_vertices(TriMesh& mesh) {
  std::vector<std::uint32_t> renamed(mesh.vertices.size(), kNoVertex);
  std::vector<Vec3> kept;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) {
      if (renamed[v] == kNoVertex) {
        renamed[v] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(mesh.vertices[v]);
      }
      v = renamed[v];
    }
  }
  const std::size_t dropped = mesh.vertices.size() - kept.size();
  mesh.vertices = std::move(kept);
  return dropped;
}

std::size_t weld_vertices(TriMesh& mesh, double distance_m) {
  constexpr double kFinest_m = 1e-12;  // cell numbers must fit 64 bits
  Places places(mesh.vertices, distance_m < kFinest_m ? 0 : distance_m);
  std::vector<std::uint32_t> stays(mesh.vertices.size());
  std::size_t joined = 0;
  for (std::uint32_t v = 0; v < stays.size(); ++v) {
    const std::uint32_t earlier = places.find(mesh.vertices[v]);
    stays[v] = earlier == kNoVertex ? v : earlier;
    if (earlier == kNoVertex)
      places.add(v);
    else
      ++joined;
  }
  for (Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = stays[v];
  drop_unused_vertices(mesh);
  return joined;
}

}  // namespace osteon
