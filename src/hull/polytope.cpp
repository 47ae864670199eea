#include "polytope.h"

#include <algorithm>
#include <cmath>

namespace osteon::hull {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array<std::uint32_t, 3> kNextSide{1, 2, 0};
/// Of the simplex's corners in the origin: uneven, so that regular clouds make few ties.
constexpr std::array<double, 4> kWeights{0.2371, 0.2629, 0.2743, 0.2257};

/// Of the product of three vectors, components up to 2, that say on which side of an edge a ray
/// goes: rounding is below 1e-13.
constexpr double kCertainlyInside = 1e-12;
/// The walk starts close by; one that goes round in circles ends here.
constexpr int kLongestWalk = 32;

double largest(const Vec3& e) {
  return std::max(std::max(std::abs(e.x()), std::abs(e.y())), std::abs(e.z()));
}

}  // namespace

Polytope::Polytope(const Cloud& cloud, const std::array<std::uint32_t, 4>& simplex)
    : cloud_(cloud) {
  const Vec3 half = 0.5 * cloud.box().hi - 0.5 * cloud.box().lo;
  for (int k = 0; k < 3; ++k) scale_[k] = scale_to_one(half[k]);
  centre_.setZero();
  for (std::size_t i = 0; i < 4; ++i) {
    centre_ += kWeights[i] * cloud.raw(simplex[i]).cwiseProduct(scale_);
  }
  for (const std::uint32_t p : simplex) vertices_.push_back({to_q(cloud.raw(p)), p});
  add_facet(0, 2, 1);
  add_facet(0, 1, 3);
  add_facet(1, 2, 3);
  add_facet(2, 0, 3);
  facets_[0].twin = {4 * 3 + 0, 4 * 2 + 0, 4 * 1 + 0};
  facets_[1].twin = {4 * 0 + 2, 4 * 2 + 2, 4 * 3 + 1};
  facets_[2].twin = {4 * 0 + 1, 4 * 3 + 2, 4 * 1 + 1};
  facets_[3].twin = {4 * 0 + 0, 4 * 1 + 2, 4 * 2 + 1};
}

void Polytope::reserve(std::size_t points) {
  vertices_.reserve(vertices_.size() + points);
  facets_.reserve(facets_.size() + 2 * points);
}

std::uint32_t Polytope::add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t place = static_cast<std::uint32_t>(facets_.size());
  if (spare_.empty()) {
    facets_.emplace_back();
  } else {
    place = spare_.back();
    spare_.pop_back();
  }
  Facet& facet = facets_[place];
  facet.v = {a, b, c};
  facet.mark = search_;
  set_plane(facet);
  return place;
}

// Error of n.q - n.a for points of the box, with u = 2^-53: each coordinate of Q, at most 2, is off
// by u and an edge by 4 u, so a component of n = e1 x e2 by 12 u (|e1| + |e2|); times two vectors
// of three components up to 2, that is 144 u (|e1| + |e2|). Rounding in the products and in the
// division by n.a adds 24 u |n|_1. The constants are rounded up by more than a third, so the same
// bound, in units of n.a, holds for w.q itself as long as that is at most 1, n.a being good to a
// 64th. Where it is not, the facet is left to exact arithmetic.
void Polytope::set_plane(Facet& facet) const {
  const Vec3& c = vertices_[facet.v[2]].q;
  const Vec3 e1 = vertices_[facet.v[0]].q - c;
  const Vec3 e2 = vertices_[facet.v[1]].q - c;
  const double nx = e1.y() * e2.z() - e1.z() * e2.y();
  const double ny = e1.z() * e2.x() - e1.x() * e2.z();
  const double nz = e1.x() * e2.y() - e1.y() * e2.x();
  const double d = (nx * c.x() + ny * c.y()) + nz * c.z();
  const double error = 2.2e-14 * (largest(e1) + largest(e2)) +
                       4e-15 * ((std::abs(nx) + std::abs(ny)) + std::abs(nz));
  const bool usable = d > 64 * error && d > 1e-280;
  const double inverse = usable ? 1.0 / d : 0.0;
  facet.wx = nx * inverse;
  facet.wy = ny * inverse;
  facet.wz = nz * inverse;
  facet.bound = usable ? error * inverse : kInfinity;
}

// Kept out of `sees`, which then is short enough to stand where it is asked.
[[gnu::noinline]] bool Polytope::sees_exactly(const Probe& probe, const Facet& facet) const {
  return cloud_.exact_side(vertices_[facet.v[0]].source, vertices_[facet.v[1]].source,
                           vertices_[facet.v[2]].source, probe.point) > 0;
}

inline bool Polytope::sees(const Probe& probe, const Facet& facet) const {
  const double rise = facet.rise(probe.q);
  if (rise > 1 + facet.bound) return true;
  if (rise < 1 - facet.bound) return false;
  return sees_exactly(probe, facet);
}

bool Polytope::on_plane(const Facet& facet, std::uint32_t vertex) const {
  if (facet.rise(vertices_[vertex].q) < 1 - facet.bound) return false;
  return cloud_.exact_side(vertices_[facet.v[0]].source, vertices_[facet.v[1]].source,
                           vertices_[facet.v[2]].source, vertices_[vertex].source) == 0;
}

bool Polytope::add(std::uint32_t point) {
  const Probe probe{to_q(cloud_.raw(point)), point};
  const std::uint32_t seen = find_seen(probe);
  if (seen == kNoIndex) return false;
  const auto apex = static_cast<std::uint32_t>(vertices_.size());
  vertices_.push_back({probe.q, point});
  cut(probe, seen);
  raise_cone(apex);
  return true;
}

/// A facet that the point sees, or none.
std::uint32_t Polytope::find_seen(const Probe& probe) {
  std::uint32_t at = here_;
  double best = facets_[at].rise(probe.q);
  for (;;) {
    const Facet& facet = facets_[at];
    if (best > 1 + facet.bound) return at;
    std::uint32_t next = at;
    double perhaps = -kInfinity;
    const double here = best;
    for (const std::uint32_t twin : facet.twin) {
      const Facet& other = facets_[twin >> 2];
      const double rise = other.rise(probe.q);
      perhaps = std::max(perhaps, rise + other.bound);
      next = rise > best ? twin >> 2 : next;
      best = rise > best ? rise : best;
    }
    if (next != at) {
      at = next;
      continue;
    }
    here_ = at;
    const double low = here - facet.bound;
    if (low > 0 && perhaps < low && best < 1 - facet.bound) return kNoIndex;
    return search_summit(probe, low);
  }
}

/// Calls visit(facet) for the facets connected to the one in hand by rises that may be
/// `low` or more, until it returns false. With `low` below the true rise of that one, what rises
/// highest is among them: on a convex polyhedron facets that rise to some height are connected.
template <class Visit>
void Polytope::explore(const Vec3& q, double low, const Visit& visit) {
  if (!(low > 0)) low = -kInfinity;  // bounds hold for rises down to -1
  ++search_;
  list_.assign(1, here_);
  facets_[here_].mark = search_;
  for (std::size_t k = 0; k < list_.size(); ++k) {
    const Facet& facet = facets_[list_[k]];
    if (!visit(list_[k])) return;
    for (const std::uint32_t twin : facet.twin) {
      Facet& other = facets_[twin >> 2];
      if (other.mark == search_) continue;
      other.mark = search_;
      if (!(other.rise(q) + other.bound < low)) list_.push_back(twin >> 2);
    }
  }
}

/// The facet through whose inside the ray to q goes for certain, or none. Goes on beyond an edge
/// that has the ray on its other side.
std::uint32_t Polytope::exit_facet(const Vec3& q) const {
  std::uint32_t at = here_;
  for (int step = 0; step < kLongestWalk; ++step) {
    const Facet& facet = facets_[at];
    const Vec3& a = vertices_[facet.v[0]].q;
    const Vec3& b = vertices_[facet.v[1]].q;
    const Vec3& c = vertices_[facet.v[2]].q;
    const std::array<double, 3> inside{a.cross(b).dot(q), b.cross(c).dot(q), c.cross(a).dot(q)};
    std::size_t worst = inside[1] < inside[0] ? 1 : 0;
    worst = inside[2] < inside[worst] ? 2 : worst;
    if (inside[worst] > kCertainlyInside) return at;
    if (inside[worst] > -kCertainlyInside) return kNoIndex;
    at = facet.twin[worst] >> 2;
  }
  return kNoIndex;
}

/// For a point so close to the surface, or to an edge's direction, that rounding could mislead.
std::uint32_t Polytope::search_summit(const Probe& probe, double low) {
  if (const std::uint32_t exit = exit_facet(probe.q); exit != kNoIndex) {
    here_ = exit;
    return sees(probe, facets_[exit]) ? exit : kNoIndex;
  }
  std::uint32_t seen = kNoIndex;
  explore(probe.q, low, [&](std::uint32_t facet) {
    if (!sees(probe, facets_[facet])) return true;
    seen = facet;
    return false;
  });
  return seen;
}

double Polytope::highest_rise(const Vec3& q) {
  double best = facets_[here_].rise(q);
  for (std::uint32_t at = kNoIndex; at != here_;) {
    at = here_;
    for (const std::uint32_t twin : facets_[at].twin) {
      const double rise = facets_[twin >> 2].rise(q);
      here_ = rise > best ? twin >> 2 : here_;
      best = rise > best ? rise : best;
    }
  }
  if (!(best > 0)) {  // at the same height as all around, but not the summit
    explore(q, best, [&](std::uint32_t facet) {
      const double rise = facets_[facet].rise(q);
      here_ = rise > best ? facet : here_;
      best = std::max(best, rise);
      return true;
    });
  }
  const double shorter = 0.9 / best;  // the bounds are for rises up to 1
  const Vec3 q_near = shorter * q;
  best = facets_[here_].rise(q_near);
  explore(q_near, best - facets_[here_].bound, [&](std::uint32_t facet) {
    best = std::max(best, facets_[facet].rise(q_near));
    return true;
  });
  return best / shorter;
}

double Polytope::worst_bound() const {
  double worst = 0;
  for (const Facet& facet : facets_) worst = std::max(worst, facet.bound);
  return worst;
}

/// Takes out the facets that the point sees, depth first, so that their rim comes in order.
void Polytope::cut(const Probe& probe, std::uint32_t first) {
  rim_.clear();
  list_.assign({4 * first + 2, 4 * first + 1, 4 * first});
  facets_[first].bound = -1;
  spare_.push_back(first);
  while (!list_.empty()) {
    const std::uint32_t edge = list_.back();
    list_.pop_back();
    const Facet& facet = facets_[edge >> 2];
    const std::uint32_t side = edge & 3;
    const std::uint32_t twin = facet.twin[side];
    Facet& other = facets_[twin >> 2];
    if (other.gone()) continue;
    if (!sees(probe, other)) {
      rim_.push_back({facet.v[side], facet.v[kNextSide[side]], twin});
      continue;
    }
    other.bound = -1;
    spare_.push_back(twin >> 2);
    const std::uint32_t one = kNextSide[twin & 3];
    list_.push_back((twin & ~3u) + kNextSide[one]);
    list_.push_back((twin & ~3u) + one);
  }
}

void Polytope::raise_cone(std::uint32_t apex) {
  std::uint32_t first = kNoIndex, before = kNoIndex;
  for (const RimEdge& edge : rim_) {
    const std::uint32_t place = add_facet(edge.from, edge.to, apex);
    facets_[place].twin[0] = edge.beyond;
    facets_[edge.beyond >> 2].twin[edge.beyond & 3] = 4 * place;
    if (before == kNoIndex) {
      first = place;
    } else {
      join(before, place);
    }
    before = place;
  }
  join(before, first);
  here_ = before;
}

/// Neighbours in a cone.
void Polytope::join(std::uint32_t before, std::uint32_t after) {
  facets_[before].twin[1] = 4 * after + 2;
  facets_[after].twin[2] = 4 * before + 1;
}

}  // namespace osteon::hull
