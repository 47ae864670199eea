#include "wrapping.h"

#include <algorithm>
#include <utility>

#include "exact/predicates.h"
#include "first_edge.h"
#include "polygon.h"

namespace osteon::hull {

namespace {

using Facet = Polytope::Facet;

constexpr std::uint32_t next_side(std::uint32_t edge) {
  return (edge & 3) == 2 ? edge - 2 : edge + 1;
}

class Wrapper {
 public:
  Wrapper(const Cloud& cloud, const Polytope& polytope)
      : cloud_(cloud), facets_(polytope.facets()), polytope_(polytope) {}

  // Symbols: edge 4 f + k is side k of triangle f, its twin the same side seen from the other
  // facet. Invariant: what is wrapped is connected, and each edge of its rim is open. Source: Chand
  // and Kapur 1970. Ends: a facet is wrapped once, and only then opens edges; when none is open the
  // surface has no rim, so it is the whole hull.
  WrappedFacets run() {
    wrapped_.assign(facets_.size(), false);
    result_.corners.reserve(3 * facets_.size());
    result_.starts.reserve(facets_.size() + 1);
    turn_to(first_facet());
    while (!open_.empty()) {
      const std::uint32_t beyond = twin(open_.back());
      open_.pop_back();
      if (!wrapped_[beyond >> 2]) turn_to(beyond);
    }
    return std::move(result_);
  }

 private:
  std::uint32_t twin(std::uint32_t edge) const { return facets_[edge >> 2].twin[edge & 3]; }
  std::uint32_t start(std::uint32_t edge) const { return facets_[edge >> 2].v[edge & 3]; }
  std::uint32_t source(std::uint32_t vertex) const { return polytope_.vertices()[vertex].source; }
  const Vec3& raw(std::uint32_t vertex) const { return cloud_.raw(source(vertex)); }

  /// The edge of the polytope with which the first edge of the hull begins.
  std::uint32_t first_facet() const {
    const DirectedEdge first = first_edge(cloud_, corners());
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      if (facets_[f].gone()) continue;
      for (std::uint32_t edge = 4 * f; edge < 4 * f + 3; ++edge) {
        if (source(start(edge)) != first.from) continue;
        const std::uint32_t end = source(start(next_side(edge)));
        if (end == first.to ||
            collinear(cloud_.raw(first.from), cloud_.raw(first.to), cloud_.raw(end))) {
          return edge;
        }
      }
    }
    return 0;
  }

  /// Sources of the vertices that facets have, rising.
  std::vector<std::uint32_t> corners() const {
    std::vector<std::uint8_t> used(polytope_.vertices().size(), false);
    for (const Facet& facet : facets_) {
      if (facet.gone()) continue;
      for (const std::uint32_t v : facet.v) used[v] = true;
    }
    std::vector<std::uint32_t> sources;
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (used[v]) sources.push_back(source(v));
    }
    return sources;
  }

  /// Takes in the facet to which the edge belongs.
  void turn_to(std::uint32_t edge) {
    if (stands_alone(edge >> 2)) {
      wrapped_[edge >> 2] = true;
      const std::uint32_t second = next_side(edge);
      for (const std::uint32_t e : {edge, second, next_side(second)}) take(e);
    } else {
      gather(edge >> 2);
      trace(start(edge));
      for (const std::uint32_t e : outline_) take(e);
    }
    result_.starts.push_back(static_cast<std::uint32_t>(result_.corners.size()));
  }

  void take(std::uint32_t edge) {
    result_.corners.push_back(source(start(edge)));
    if (!wrapped_[twin(edge) >> 2]) open_.push_back(edge);
  }

  /// Whether the triangle beyond an edge lies in the plane of this one.
  bool is_flat(const Facet& facet, std::uint32_t beyond) const {
    return !wrapped_[beyond >> 2] && polytope_.on_plane(facet, start(next_side(next_side(beyond))));
  }

  bool stands_alone(std::uint32_t triangle) const {
    const Facet& facet = facets_[triangle];
    return !is_flat(facet, facet.twin[0]) && !is_flat(facet, facet.twin[1]) &&
           !is_flat(facet, facet.twin[2]);
  }

  /// All triangles of the plane of one: they are connected.
  void gather(std::uint32_t first) {
    plane_.assign(1, first);
    wrapped_[first] = true;
    for (std::size_t k = 0; k < plane_.size(); ++k) {
      const Facet& facet = facets_[plane_[k]];
      for (const std::uint32_t beyond : facet.twin) {
        if (!is_flat(facet, beyond)) continue;
        wrapped_[beyond >> 2] = true;
        plane_.push_back(beyond >> 2);
      }
    }
  }

  bool on_outline(std::uint32_t edge) const { return !in_plane_[twin(edge) >> 2]; }

  /// The edges around the triangles gathered, each from a corner on. `corner` is any of these.
  void trace(std::uint32_t corner) {
    in_plane_.resize(facets_.size(), 0);
    for (const std::uint32_t f : plane_) in_plane_[f] = 1;
    walk_round();
    for (const std::uint32_t f : plane_) in_plane_[f] = 0;
    drop_straight_places();
    const auto at = [&](std::uint32_t e) { return start(e) == corner; };
    std::rotate(outline_.begin(), std::find_if(outline_.begin(), outline_.end(), at),
                outline_.end());
    start_at_lowest();
  }

  /// As wrap_polygon does.
  void start_at_lowest() {
    const auto corner = [&](std::size_t k) { return source(start(outline_[k])); };
    const Projection axes = projection_of(cloud_, corner(0), corner(1), corner(2));
    const auto lower = [&](std::uint32_t a, std::uint32_t b) {
      const Vec3& p = raw(start(a));
      const Vec3& q = raw(start(b));
      return p[axes.i] != q[axes.i] ? p[axes.i] < q[axes.i] : p[axes.j] < q[axes.j];
    };
    std::rotate(outline_.begin(), std::min_element(outline_.begin(), outline_.end(), lower),
                outline_.end());
  }

  void walk_round() {
    std::uint32_t first = kNoIndex;
    for (const std::uint32_t f : plane_) {
      for (std::uint32_t edge = 4 * f; edge < 4 * f + 3 && first == kNoIndex; ++edge) {
        if (on_outline(edge)) first = edge;
      }
    }
    outline_.clear();
    std::uint32_t edge = first;
    do {
      outline_.push_back(edge);
      edge = next_side(edge);
      while (!on_outline(edge)) edge = next_side(twin(edge));
    } while (edge != first);
  }

  void drop_straight_places() {
    bent_.clear();
    const std::size_t n = outline_.size();
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t before = outline_[(k + n - 1) % n], after = outline_[(k + 1) % n];
      if (!collinear(raw(start(before)), raw(start(outline_[k])), raw(start(after)),
                     cloud_.exact_counter())) {
        bent_.push_back(outline_[k]);
      }
    }
    outline_.swap(bent_);
  }

  const Cloud& cloud_;
  std::span<const Facet> facets_;
  const Polytope& polytope_;
  std::vector<std::uint8_t> wrapped_, in_plane_;  ///< of each triangle: bool
  std::vector<std::uint32_t> open_;               ///< edges with a facet on their left, at least
  std::vector<std::uint32_t> plane_;              ///< triangles of the facet in hand
  std::vector<std::uint32_t> outline_;            ///< its edges
  std::vector<std::uint32_t> bent_;
  WrappedFacets result_;
};

}  // namespace

WrappedFacets wrap(const Cloud& cloud, const Polytope& polytope) {
  return Wrapper(cloud, polytope).run();
}

}  // namespace osteon::hull
