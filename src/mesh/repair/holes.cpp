#include "repair/holes.h"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "repair/edges.h"
#include "repair/flat_lid.h"
#include "repair/patches.h"
#include "repair/triangulate_loop.h"

namespace osteon {
namespace {

constexpr std::size_t kNoPlace = std::numeric_limits<std::size_t>::max();
// A lid of more than this share of its part's area would make a solid of a sheet.
constexpr double kLargestLid = 0.9;
// Of a long cylinder cut off square, a lid has radius / (2 length) of the area: of a bone's shaft
// some hundredths, and a hole in its wall far less.
constexpr double kEndOfShaft = 0.01;
// Clipping ears takes the square of this many steps.
constexpr std::size_t kLongestFlatRim = 5000;

// Side of a hole, run against the triangle on it.
struct RimEdge {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t triangle = 0;
  auto key() const { return std::tie(from, to, triangle); }
};

struct Loop {
  std::vector<std::uint32_t> corners;
  std::uint32_t triangle = 0;  ///< one on the rim
};

std::vector<RimEdge> rim_edges(const std::vector<Triangle>& triangles,
                               const std::vector<EdgeUse>& uses) {
  std::vector<RimEdge> rim;
  for_each_edge(uses, [&](auto first, auto last) {
    if (last - first != 1) return;
    const Triangle& t = triangles[first->triangle];
    rim.push_back({t[(first->corner + 1u) % 3], t[first->corner], first->triangle});
  });
  std::sort(rim.begin(), rim.end(),
            [](const RimEdge& a, const RimEdge& b) { return a.key() < b.key(); });
  return rim;
}

// Takes simple loops off the rim; where loops touch in a corner, each is closed as soon as the walk
// meets itself.
class RimWalk {
 public:
  RimWalk(std::vector<RimEdge> rim, std::size_t vertex_count)
      : rim_(std::move(rim)), used_(rim_.size(), 0), place_(vertex_count, kNoPlace) {}

  void run() {
    for (std::size_t e = 0; e < rim_.size(); ++e)
      if (!used_[e]) walk_from(rim_[e].from);
  }

  std::vector<Loop> loops;
  std::size_t dead_ends = 0;

 private:
  std::size_t next_unused(std::uint32_t from) const {
    auto at = std::lower_bound(rim_.begin(), rim_.end(), from,
                               [](const RimEdge& e, std::uint32_t v) { return e.from < v; });
    for (; at != rim_.end() && at->from == from; ++at)
      if (!used_[static_cast<std::size_t>(at - rim_.begin())])
        return static_cast<std::size_t>(at - rim_.begin());
    return kNoPlace;
  }

  void walk_from(std::uint32_t start) {
    std::vector<std::uint32_t> path{start};
    place_[start] = 0;
    for (;;) {
      const std::size_t e = next_unused(path.back());
      if (e == kNoPlace) break;
      used_[e] = 1;
      const std::uint32_t to = rim_[e].to;
      if (place_[to] == kNoPlace) {
        place_[to] = path.size();
        path.push_back(to);
      } else {
        close_loop(path, place_[to], rim_[e].triangle);
      }
    }
    if (path.size() > 1) ++dead_ends;
    for (const std::uint32_t v : path) place_[v] = kNoPlace;
  }

  void close_loop(std::vector<std::uint32_t>& path, std::size_t first, std::uint32_t triangle) {
    Loop loop;
    loop.corners.assign(path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
    loop.triangle = triangle;
    for (std::size_t i = first + 1; i < path.size(); ++i) place_[path[i]] = kNoPlace;
    path.resize(first + 1);
    loops.push_back(std::move(loop));
  }

  std::vector<RimEdge> rim_;
  std::vector<char> used_;
  std::vector<std::size_t> place_;  ///< of each vertex on the path
};

// Edges that a lid must not touch.
class TakenEdges {
 public:
  explicit TakenEdges(const std::vector<EdgeUse>& uses) {
    for (const EdgeUse& use : uses) old_.push_back({use.lo, use.hi});
  }
  bool has(std::uint32_t a, std::uint32_t b) const {
    const Edge edge = std::minmax(a, b);
    return std::binary_search(old_.begin(), old_.end(), edge) || fresh_.count(edge) > 0;
  }
  void add(const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k) fresh_.insert(std::minmax(t[k], t[(k + 1) % 3]));
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> old_;  ///< sorted, as the uses are
  std::set<Edge> fresh_;
};

std::vector<double> component_areas(const TriMesh& mesh,
                                    const std::vector<std::uint32_t>& component) {
  std::vector<double> areas(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < component.size(); ++t)
    areas[component[t]] += triangle_area(mesh, static_cast<std::uint32_t>(t));
  return areas;
}

std::vector<Triangle> lid_on(const TriMesh& mesh, const Loop& loop, std::size_t largest_edges,
                             const TakenEdges& taken) {
  const auto may_join = [&taken](std::uint32_t a, std::uint32_t b) { return !taken.has(a, b); };
  if (loop.corners.size() <= largest_edges)
    return triangulate_loop(mesh.vertices, loop.corners, may_join);
  if (loop.corners.size() > kLongestFlatRim) return {};
  return flat_lid(mesh.vertices, loop.corners, may_join);
}

enum class Filled : std::uint8_t { kNo, kHole, kEnd };

Filled fill(TriMesh& mesh, const Loop& loop, double part_area, std::size_t largest_edges,
            TakenEdges& taken) {
  const std::vector<Triangle> lid = lid_on(mesh, loop, largest_edges, taken);
  if (lid.empty()) return Filled::kNo;
  const std::size_t before = mesh.triangles.size();
  mesh.triangles.insert(mesh.triangles.end(), lid.begin(), lid.end());
  double lid_area = 0;
  for (std::size_t t = before; t < mesh.triangles.size(); ++t)
    lid_area += triangle_area(mesh, static_cast<std::uint32_t>(t));
  if (lid_area > kLargestLid * part_area) {
    mesh.triangles.resize(before);
    return Filled::kNo;
  }
  for (const Triangle& t : lid) taken.add(t);
  return lid_area > kEndOfShaft * part_area ? Filled::kEnd : Filled::kHole;
}

}  // namespace

HoleCount fill_holes(TriMesh& mesh, std::size_t largest_edges) {
  const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
  RimWalk walk(rim_edges(mesh.triangles, uses), mesh.vertices.size());
  walk.run();
  HoleCount count;
  count.open = walk.dead_ends;
  if (walk.loops.empty()) return count;
  const std::vector<std::uint32_t> component = triangle_components(mesh.triangles, uses);
  const std::vector<double> areas = component_areas(mesh, component);
  TakenEdges taken(uses);
  for (const Loop& loop : walk.loops) {
    const double part_area = areas[component[loop.triangle]];
    const Filled filled = fill(mesh, loop, part_area, largest_edges, taken);
    count.filled += filled != Filled::kNo;
    count.ends += filled == Filled::kEnd;
    count.open += filled == Filled::kNo;
  }
  return count;
}

}  // namespace osteon
