#include "quickhull.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "initial_simplex.h"
#include "predicates.h"

namespace osteon::hull {

namespace {

/// Facets with no more points outside than this are left to the wrapping.
constexpr std::size_t kLeftToWrapping = 4;
constexpr std::uint32_t kNone = 0xffffffffu;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Facet {
  std::array<std::uint32_t, 3> v;         ///< counter-clockwise from outside
  std::array<std::uint32_t, 3> adjacent;  ///< across v[i], v[i + 1]
  FilterPlane plane;
  std::vector<std::uint32_t> outside;  ///< points strictly above this facet
  std::uint32_t farthest = kNone;
  double farthest_height = 0;
  std::uint32_t seen_from = kNone;  ///< last point from which the facet was looked at
  bool visible = false;             ///< from that point
  bool alive = true;
};

class Grower {
 public:
  explicit Grower(const Cloud& cloud) : cloud_(cloud), facet_starting_at_(cloud.size(), kNone) {}

  void start(const std::array<std::uint32_t, 4>& corners);
  void grow();
  Shell collect();

 private:
  std::uint32_t add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void insert(std::uint32_t facet);
  bool above(const Facet& f, std::uint32_t point) const;
  void look(std::uint32_t first, std::uint32_t apex);
  void raise_cone(std::uint32_t apex);
  void note_planes();
  void assign(std::uint32_t point);
  std::uint32_t exact_facet_below(std::uint32_t point);
  void collect_vertices(Shell& shell);
  void drop_copies(std::vector<std::uint32_t>& points);

  const Cloud& cloud_;
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> queue_;
  std::vector<std::uint32_t> facet_starting_at_;  ///< new facet by the first vertex of its base
  std::vector<std::uint32_t> visible_;
  struct HorizonEdge {
    std::uint32_t from, to, beyond, beyond_side;
  };
  std::vector<HorizonEdge> horizon_;
  std::vector<std::uint32_t> fresh_;       ///< facets to which points are being shared out
  std::vector<FilterPlane> fresh_planes_;  ///< theirs, side by side
  std::vector<std::vector<std::uint32_t>> spare_lists_;
  std::vector<std::uint32_t> number_;  ///< survivor of each point
  std::size_t duplicates_ = 0;
};

bool Grower::above(const Facet& f, std::uint32_t point) const {
  const double h = f.plane.height(cloud_.scaled(point));
  if (h > f.plane.bound) return true;
  if (h < -f.plane.bound) return false;
  return cloud_.exact_side(f.v[0], f.v[1], f.v[2], point) > 0;
}

std::uint32_t Grower::add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Facet f;
  f.v = {a, b, c};
  f.adjacent = {kNone, kNone, kNone};
  f.plane = cloud_.plane(a, b, c);
  if (!spare_lists_.empty()) {
    f.outside = std::move(spare_lists_.back());
    spare_lists_.pop_back();
  }
  facets_.push_back(std::move(f));
  return static_cast<std::uint32_t>(facets_.size() - 1);
}

/// corners[3] lies above the triangle of the other three.
void Grower::start(const std::array<std::uint32_t, 4>& corners) {
  const auto [a, b, c, d] = corners;
  fresh_ = {add_facet(a, c, b), add_facet(a, b, d), add_facet(b, c, d), add_facet(c, a, d)};
  facets_[0].adjacent = {3, 2, 1};
  facets_[1].adjacent = {0, 2, 3};
  facets_[2].adjacent = {0, 3, 1};
  facets_[3].adjacent = {0, 1, 2};
  note_planes();
  for (std::uint32_t i = 0; i < cloud_.size(); ++i) {
    if (i != a && i != b && i != c && i != d) assign(i);
  }
  queue_ = fresh_;
}

void Grower::grow() {
  for (std::size_t i = 0; i < queue_.size(); ++i) {
    const Facet& f = facets_[queue_[i]];
    if (f.alive && f.outside.size() > kLeftToWrapping) insert(queue_[i]);
  }
}

void Grower::insert(std::uint32_t facet) {
  const std::uint32_t apex = facets_[facet].farthest;
  look(facet, apex);
  raise_cone(apex);
  for (const std::uint32_t dead : visible_) {
    std::vector<std::uint32_t> points = std::move(facets_[dead].outside);
    facets_[dead].outside.clear();
    for (const std::uint32_t p : points) {
      if (p != apex) assign(p);
    }
    points.clear();
    spare_lists_.push_back(std::move(points));
  }
  queue_.insert(queue_.end(), fresh_.begin(), fresh_.end());
}

/// Finds the facets below the apex and the closed line of edges around them.
void Grower::look(std::uint32_t first, std::uint32_t apex) {
  visible_ = {first};
  horizon_.clear();
  facets_[first].seen_from = apex;
  facets_[first].visible = true;
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    Facet& f = facets_[visible_[k]];
    f.alive = false;
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t n = f.adjacent[side];
      Facet& g = facets_[n];
      if (g.seen_from != apex) {
        g.seen_from = apex;
        g.visible = above(g, apex);
        if (g.visible) visible_.push_back(n);
      }
      if (g.visible) continue;
      const auto at = std::find(g.adjacent.begin(), g.adjacent.end(), visible_[k]);
      horizon_.push_back(
          {f.v[side], f.v[(side + 1) % 3], n, static_cast<std::uint32_t>(at - g.adjacent.begin())});
    }
  }
}

void Grower::raise_cone(std::uint32_t apex) {
  fresh_.clear();
  for (const HorizonEdge& e : horizon_) {
    const std::uint32_t f = add_facet(e.from, e.to, apex);
    facets_[f].adjacent[0] = e.beyond;
    facets_[e.beyond].adjacent[e.beyond_side] = f;
    facet_starting_at_[e.from] = f;
    fresh_.push_back(f);
  }
  for (const std::uint32_t f : fresh_) {
    const std::uint32_t next = facet_starting_at_[facets_[f].v[1]];
    facets_[f].adjacent[1] = next;
    facets_[next].adjacent[2] = f;
  }
  note_planes();
}

void Grower::note_planes() {
  fresh_planes_.clear();
  for (const std::uint32_t f : fresh_) fresh_planes_.push_back(facets_[f].plane);
}

/// To the fresh facet that the point is highest above, or to none: then it lies in the polyhedron.
/// (A point above a facet that went, and outside now, is above one of the facets that replace it.)
void Grower::assign(std::uint32_t point) {
  const Vec3& q_S = cloud_.scaled(point);
  std::size_t best = 0;
  double surely = -kInfinity, perhaps = -kInfinity;
  for (std::size_t i = 0; i < fresh_planes_.size(); ++i) {
    const double h = fresh_planes_[i].height(q_S);
    const double low = h - fresh_planes_[i].bound;
    const double high = h + fresh_planes_[i].bound;
    best = low > surely ? i : best;
    surely = low > surely ? low : surely;
    perhaps = high > perhaps ? high : perhaps;
  }
  if (perhaps < 0) return;
  const std::uint32_t facet = surely > 0 ? fresh_[best] : exact_facet_below(point);
  if (facet == kNone) return;
  Facet& f = facets_[facet];
  f.outside.push_back(point);
  if (f.farthest == kNone || surely > f.farthest_height) {
    f.farthest = point;
    f.farthest_height = surely;
  }
}

/// For a point so close to the polyhedron that the filter cannot tell.
std::uint32_t Grower::exact_facet_below(std::uint32_t point) {
  for (const std::uint32_t f : fresh_) {
    for (const std::uint32_t v : facets_[f].v) {
      if (cloud_.raw(v) != cloud_.raw(point)) continue;
      ++duplicates_;
      return kNone;
    }
  }
  for (const std::uint32_t f : fresh_) {
    if (above(facets_[f], point)) return f;
  }
  return kNone;
}

/// Copies of a point are always assigned together, so they meet in one list.
void Grower::drop_copies(std::vector<std::uint32_t>& points) {
  const auto less = [this](std::uint32_t i, std::uint32_t j) {
    if (cloud_.raw(i) == cloud_.raw(j)) return i < j;
    return lexicographic_less(cloud_.raw(i), cloud_.raw(j));
  };
  const auto same = [this](std::uint32_t i, std::uint32_t j) {
    return cloud_.raw(i) == cloud_.raw(j);
  };
  std::sort(points.begin(), points.end(), less);
  const auto end = std::unique(points.begin(), points.end(), same);
  duplicates_ += static_cast<std::size_t>(points.end() - end);
  points.erase(end, points.end());
}

/// Numbers the vertices of the living facets.
void Grower::collect_vertices(Shell& shell) {
  number_.assign(cloud_.size(), kNone);
  for (const Facet& f : facets_) {
    if (!f.alive) continue;
    for (const std::uint32_t v : f.v) {
      if (number_[v] != kNone) continue;
      number_[v] = static_cast<std::uint32_t>(shell.points.size());
      shell.points.push_back(v);
    }
  }
  shell.vertices = static_cast<std::uint32_t>(shell.points.size());
}

Shell Grower::collect() {
  Shell shell;
  collect_vertices(shell);
  std::vector<std::uint32_t> facet_number(facets_.size(), kNone);
  std::uint32_t living = 0;
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    if (facets_[i].alive) facet_number[i] = living++;
  }
  shell.facets.reserve(living);
  for (Facet& f : facets_) {
    if (!f.alive) continue;
    drop_copies(f.outside);
    Shell::Facet kept{f.v, f.adjacent, f.plane, static_cast<std::uint32_t>(shell.points.size()), 0};
    shell.points.insert(shell.points.end(), f.outside.begin(), f.outside.end());
    kept.outside_end = static_cast<std::uint32_t>(shell.points.size());
    for (std::uint32_t& v : kept.v) v = number_[v];
    for (std::uint32_t& n : kept.adjacent) n = facet_number[n];
    shell.facets.push_back(kept);
  }
  shell.duplicates = duplicates_;
  return shell;
}

}  // namespace

Shell quickhull(const Cloud& cloud) {
  const Simplex simplex = find_simplex(cloud);
  if (simplex.failure) {
    Shell shell;
    shell.failure = simplex.failure;
    return shell;
  }
  Grower grower(cloud);
  grower.start(simplex.corners);
  grower.grow();
  return grower.collect();
}

}  // namespace osteon::hull
