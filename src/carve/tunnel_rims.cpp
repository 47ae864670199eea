#include "tunnel_rims.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace osteon::tunnel {
namespace {

/// A station on the way round a facet.
struct Station {
  std::uint32_t point = 0;
  int side = -1;          ///< of the prism, at a crossing
  bool entering = false;  ///< at a crossing
  bool inside = false;    ///< at a corner
  std::size_t edge = 0;   ///< of the facet, that begins here or that this lies on
  bool is_crossing() const { return side >= 0; }
  bool begins_inside() const { return is_crossing() ? entering : inside; }
};

class FacetCutter {
 public:
  FacetCutter(Patch& patch, const Prism& prism, const EdgeTable& edges, Rims& rims)
      : patch_(patch), prism_(prism), edges_(edges), rims_(rims) {}

  bool cut(const Facet& f) {
    if (!f.near) return keep(f.v);
    walk(f);
    const bool crossed = way_.size() > 3;
    if (f.layer != Layer::kWithin) return crossed ? keep_whole(f) : keep(f.v);
    note_ends(f);
    if (crossed) return cut_apart(f);
    if (way_[0].inside) return true;
    return holds_axis(f) ? keep_ring(f) : keep(f.v);
  }

 private:
  bool keep(const Triangle& t) {
    rims_.kept.push_back(t);
    return true;
  }

  void walk(const Facet& f) {
    way_.clear();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = f.v[k], b = f.v[(k + 1) % 3];
      way_.push_back({a, -1, false, edges_.inside(a), k});
      const CrossedEdge* edge = edges_.find(a, b);
      if (!edge) continue;
      const bool along = a == edge->key.lo;
      for (std::size_t i = 0; i < edge->count; ++i) {
        const Crossing& c = edge->crossings[along ? i : edge->count - 1 - i];
        way_.push_back({c.point, c.side, c.entering == along, false, k});
      }
    }
  }

  const Vec3& at(std::uint32_t point) const { return patch_.points_A[point]; }

  /// Twice the facet's area seen along the axis; positive where it faces along it.
  double facing(const Facet& f) const {
    return turn(flat(at(f.v[0])), flat(at(f.v[1])), flat(at(f.v[2])));
  }

  bool holds_axis(const Facet& f) const {
    const Vec2 a = flat(at(f.v[0])), b = flat(at(f.v[1])), c = flat(at(f.v[2])), o = Vec2::Zero();
    const double ab = turn(a, b, o), bc = turn(b, c, o), ca = turn(c, a, o);
    return (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
  }

  /// A point where column k goes through the facet's plane.
  std::uint32_t add_column_point(const Facet& f, int k, bool leaving) {
    const Vec3 &a = at(f.v[0]), &b = at(f.v[1]), &c = at(f.v[2]);
    const Vec2 p = prism_.column(k);
    const double wa = turn(flat(b), flat(c), p), wb = turn(flat(c), flat(a), p),
                 wc = turn(flat(a), flat(b), p);
    const double z = std::clamp((wa * a.z() + wb * b.z() + wc * c.z()) / (wa + wb + wc),
                                std::min({a.z(), b.z(), c.z()}), std::max({a.z(), b.z(), c.z()}));
    const auto point = static_cast<std::uint32_t>(patch_.points_A.size());
    patch_.points_A.emplace_back(p.x(), p.y(), z);
    rims_.columns[static_cast<std::size_t>(prism_.wrapped(k))].push_back({z, point, leaving});
    return point;
  }

  void add_rim(int side, std::uint32_t from, std::uint32_t to) {
    rims_.on_sides[static_cast<std::size_t>(prism_.wrapped(side))].push_back({from, to});
  }

  /// The rim in the facet from where its edge leaves the prism to where the next one enters it:
  /// points on the columns between. It runs the way in which the facet turns about the axis.
  std::vector<std::uint32_t> add_arc(const Facet& f, const Station& from, const Station& to) {
    std::vector<std::uint32_t> arc;
    const bool up = facing(f) > 0;
    const int count = prism_.wrapped(up ? to.side - from.side : from.side - to.side);
    std::uint32_t last = from.point;
    for (int i = 0; i < count; ++i) {
      arc.push_back(add_column_point(f, up ? from.side + 1 + i : from.side - i, up));
      add_rim(up ? from.side + i : from.side - i, last, arc.back());
      last = arc.back();
    }
    add_rim(to.side, last, to.point);
    return arc;
  }

  bool cut_apart(const Facet& f) {
    const std::size_t n = way_.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!way_[i].is_crossing() || way_[i].entering) continue;
      std::vector<std::uint32_t> loop{way_[i].point};
      std::size_t j = (i + 1) % n;
      for (; !way_[j].is_crossing(); j = (j + 1) % n) {
        if (way_[j].inside || loop.size() > n) return false;
        loop.push_back(way_[j].point);
      }
      if (!way_[j].entering) return false;
      loop.push_back(way_[j].point);
      const auto arc = add_arc(f, way_[i], way_[j]);
      loop.insert(loop.end(), arc.rbegin(), arc.rend());
      if (!fill(f, {loop})) return false;
    }
    return true;
  }

  bool keep_whole(const Facet& f) {
    std::vector<std::uint32_t> loop;
    for (const Station& s : way_) loop.push_back(s.point);
    return fill(f, {loop});
  }

  /// The whole rim lies in one facet.
  bool keep_ring(const Facet& f) {
    const bool up = facing(f) > 0;
    std::vector<std::uint32_t> ring;
    for (int k = 0; k < prism_.sides(); ++k) ring.push_back(add_column_point(f, k, up));
    for (int k = 0; k < prism_.sides(); ++k) {
      const std::uint32_t a = ring[static_cast<std::size_t>(k)],
                          b = ring[static_cast<std::size_t>(prism_.wrapped(k + 1))];
      add_rim(k, up ? a : b, up ? b : a);
    }
    if (up) std::reverse(ring.begin(), ring.end());
    return fill(f, {{f.v[0], f.v[1], f.v[2]}, ring});
  }

  /// Triangulates a part of the facet in the plane of two coordinates that shows most of it.
  bool fill(const Facet& f, const std::vector<std::vector<std::uint32_t>>& loops) {
    const Vec3 normal = (at(f.v[1]) - at(f.v[0])).cross(at(f.v[2]) - at(f.v[0]));
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Index i = (axis + 1) % 3, j = (axis + 2) % 3;
    const bool front = normal[axis] > 0;
    const Vec3 middle = at(f.v[0]);
    std::vector<FlatPoint> points;
    std::vector<Side> sides;
    for (const auto& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec3 p = at(loop[k]) - middle;
        points.push_back({loop[k], front ? Vec2(p[i], p[j]) : Vec2(p[j], p[i])});
        sides.push_back({loop[k], loop[(k + 1) % loop.size()]});
      }
    return fill_region(std::move(points), sides, rims_.kept);
  }

  std::optional<End> end_of(const Facet& f, std::size_t edge) const {
    const double z = at(f.v[edge]).z();
    if (z != at(f.v[(edge + 1) % 3]).z()) return std::nullopt;
    if (z == prism_.start) return kStart;
    if (z == prism_.end) return kEnd;
    return std::nullopt;
  }

  /// Notes where the facet's edge along an end's plane runs inside the prism and crosses its sides.
  void note_ends(const Facet& f) {
    for (std::size_t i = 0; i < way_.size(); ++i) {
      const Station &from = way_[i], &to = way_[(i + 1) % way_.size()];
      const auto end = end_of(f, from.edge);
      if (!end) continue;
      if (from.is_crossing())
        rims_.on_ends[*end][static_cast<std::size_t>(from.side)].push_back(from.point);
      if (from.begins_inside()) rims_.across_ends[*end].push_back({from.point, to.point});
    }
  }

  Patch& patch_;
  const Prism& prism_;
  const EdgeTable& edges_;
  Rims& rims_;
  std::vector<Station> way_;
};

}  // namespace

bool cut_facets(Patch& patch, const Prism& prism, const EdgeTable& edges, Rims& rims) {
  const auto n = static_cast<std::size_t>(prism.sides());
  rims.columns.resize(n);
  rims.on_sides.resize(n);
  for (auto& end : rims.on_ends) end.resize(n);
  FacetCutter cutter(patch, prism, edges, rims);
  const std::vector<Facet> facets = patch.facets;
  for (const Facet& f : facets)
    if (!cutter.cut(f)) return false;
  for (auto& column : rims.columns)
    std::sort(column.begin(), column.end(), [](const ColumnPoint& a, const ColumnPoint& b) {
      return a.z != b.z ? a.z < b.z : a.point < b.point;
    });
  return true;
}

}  // namespace osteon::tunnel
