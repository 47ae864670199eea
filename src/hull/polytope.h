#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cloud.h"
#include "initial_simplex.h"

namespace osteon::hull {

/// Convex polyhedron with triangles for facets that grows point by point: a point outside sees some
/// facets, these give way to a cone over their border. Exact: what floating point cannot decide is
/// decided on the input.
///
/// It lives in a frame Q in which the cloud's box has sides between 1 and 2 (powers of two, so
/// nothing is rounded by them) and the origin lies inside. A facet's plane is w.q = 1 there: w is
/// a vertex of the polar polyhedron, whether a point sees the facet is one product, and the facet
/// that the ray to a point leaves by has the largest w.q of all. A linear function over a convex
/// polyhedron has no local maximum but the largest, so that facet, or one that the point sees, is
/// found by climbing from facet to facet.
class Polytope {
 public:
  struct alignas(64) Facet {
    double wx, wy, wz;                  ///< plane w.q = 1
    double bound;                       ///< of the error of w.q; negative once the facet is gone
    std::array<std::uint32_t, 3> v;     ///< counter-clockwise from outside
    std::array<std::uint32_t, 3> twin;  ///< of the edge v[i], v[i + 1]: 4 facet + side, beyond it
    std::uint32_t mark;                 ///< last search that came by

    bool gone() const { return bound < 0; }
    double rise(const Vec3& q) const { return (wx * q.x() + wy * q.y()) + wz * q.z(); }
  };
  struct Vertex {
    Vec3 q;
    std::uint32_t source;  ///< index in the cloud
  };

  /// The cloud outlives the polytope. The simplex spans a volume.
  Polytope(const Cloud& cloud, const std::array<std::uint32_t, 4>& simplex);

  /// Takes a point of the cloud in. False when it lies inside or on the surface, and nothing was
  /// to do.
  bool add(std::uint32_t point);

  /// Room for some more points.
  void reserve(std::size_t points);
  /// Has the processor fetch a point that is to come soon.
  void fetch(std::uint32_t point) const { __builtin_prefetch(&cloud_.raw(point)); }

  /// A point of the input's frame in Q.
  Vec3 to_q(const Vec3& p) const { return p.cwiseProduct(scale_) - centre_; }
  /// Largest w.q of all facets, q not the origin: the surface crosses the ray to q at q over this.
  /// Good to `worst_bound`, relatively.
  double highest_rise(const Vec3& q);
  /// Largest error of any facet's w.q, for points where it is at most 1.
  double worst_bound() const;

  /// Some are gone.
  std::span<const Facet> facets() const { return facets_; }
  /// Those that no facet names any longer as well.
  std::span<const Vertex> vertices() const { return vertices_; }
  /// Names another point of the same place as the source of a vertex.
  void rename(std::uint32_t vertex, std::uint32_t source) { vertices_[vertex].source = source; }
  /// Whether the vertex, not of the facet, lies on the facet's plane; given it is not above.
  bool on_plane(const Facet& facet, std::uint32_t vertex) const;

 private:
  struct Probe {
    Vec3 q;
    std::uint32_t point;
  };
  struct RimEdge {
    std::uint32_t from, to, beyond;  ///< `beyond`: its twin
  };

  std::uint32_t add_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void set_plane(Facet& facet) const;
  bool sees(const Probe& probe, const Facet& facet) const;
  bool sees_exactly(const Probe& probe, const Facet& facet) const;
  std::uint32_t find_seen(const Probe& probe);
  std::uint32_t exit_facet(const Vec3& q) const;
  std::uint32_t search_summit(const Probe& probe, double low);
  template <class Visit>
  void explore(const Vec3& q, double low, const Visit& visit);
  void cut(const Probe& probe, std::uint32_t first);
  void raise_cone(std::uint32_t apex);
  void join(std::uint32_t before, std::uint32_t after);

  const Cloud& cloud_;
  Vec3 scale_, centre_;
  std::vector<Facet> facets_;
  std::vector<Vertex> vertices_;
  std::uint32_t here_ = 0;  ///< where the next climb starts
  std::uint32_t search_ = 0;
  std::vector<std::uint32_t> list_;   ///< of a search: facets, or edges to cross
  std::vector<std::uint32_t> spare_;  ///< places of facets that are gone
  std::vector<RimEdge> rim_;          ///< of the facets seen, in order
};

}  // namespace osteon::hull
