#include "surface/cut_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "surface/shapes.h"
#include "surface/surface.h"

namespace osteon {
namespace {

constexpr double kCell_m = 0.001;             // about as far apart as vertices are
constexpr std::size_t kMostInAll = 1u << 21;  // cells: of a larger surface they are wider
constexpr int kMostCells = 6;                 // so deep a cut takes light from its surface
constexpr double kEven_m = 0.0007;     // farther than the nearest: light is taken of those too
constexpr double kAsItWas_m = 0.0003;  // less deep is the surface as it was
constexpr double kDarkAt_m = 0.008;    // so deep a cut sees a quarter of the sky
constexpr std::uint8_t kOpened = 100;  // of the cavity of a cut face

using CellAt = std::array<int, 3>;

}  // namespace

/// The surface at rest by cells of room.
class LightByCell {
 public:
  LightByCell(Surface rest, const std::vector<ShadedMesh::Shade>& shades)
      : rest_(std::move(rest)), shades_(shades) {
    const std::vector<Vec3>& points = rest_.points;
    Vec3 hi = lo_;
    if (!points.empty()) lo_ = hi = points.front();
    for (const Vec3& p : points) lo_ = lo_.cwiseMin(p), hi = hi.cwiseMax(p);
    const auto cells = [&] {
      std::size_t count = 1;
      for (int a = 0; a < 3; ++a) {
        count_[a] = static_cast<int>((hi[a] - lo_[a]) / cell_m_) + 1;
        count *= static_cast<std::size_t>(count_[a]);
      }
      return count;
    };
    while (cells() > kMostInAll) cell_m_ *= 2;
    // The points of a cell stand one after the other: first how many each has, then which.
    first_.assign(cells() + 1, 0);
    for (const Vec3& p : points) ++first_[index_of(cell_at(p)) + 1];
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    points_.resize(points.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t k = 0; k < points.size(); ++k)
      points_[next[index_of(cell_at(points[k]))]++] = k;
  }

  struct Near {
    double away_m;
    std::uint32_t point;
  };
  /// `near` is room that calls one after the other share.
  ShadedMesh::Shade at(const Vec3& p, std::vector<Near>& near) const {
    ShadedMesh::Shade out{255, 128, 128, 128};
    find_near(p, near);
    if (near.empty()) return out;
    std::array<double, 3> sum{};
    double weights = 0, depth = 0;
    for (const Near& one : near) {
      const double left = 1 - (one.away_m - near.front().away_m) / kEven_m;
      if (!(left > 0)) continue;
      const ShadedMesh::Shade& shade = shades_[one.point];
      const double weight = left * left;
      sum[0] += weight * shade.openness;
      sum[1] += weight * shade.cavity;
      sum[2] += weight * shade.mottle;
      depth += weight * (rest_.points[one.point] - p).dot(rest_.normals[one.point]);
      weights += weight;
    }
    return shaded(sum, weights, depth / weights);
  }

 private:
  static ShadedMesh::Shade shaded(const std::array<double, 3>& sum, double weights,
                                  double depth_m) {
    const auto byte = [&](double value) {
      return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
    };
    const double open =
        depth_m > kAsItWas_m ? std::clamp(1 - 0.75 * depth_m / kDarkAt_m, 0.25, 1.0) : 1;
    return {byte(open * sum[0] / weights), depth_m > kAsItWas_m ? kOpened : byte(sum[1] / weights),
            byte(sum[2] / weights), 128};
  }

  /// The nearest first.
  void find_near(const Vec3& p, std::vector<Near>& near) const {
    near.clear();
    const CellAt middle = cell_at(p);
    for (int ring = 0; ring <= kMostCells; ++ring) {
      const bool last = !near.empty();  // one more ring: what is in it may be nearer
      add_ring(p, middle, ring, near);
      if (last) break;
    }
    const auto nearest = std::min_element(
        near.begin(), near.end(),
        [](const Near& one, const Near& other) { return one.away_m < other.away_m; });
    if (nearest != near.end()) std::iter_swap(near.begin(), nearest);
  }

  void add_ring(const Vec3& p, const CellAt& middle, int ring, std::vector<Near>& near) const {
    for (int x = -ring; x <= ring; ++x)
      for (int y = -ring; y <= ring; ++y)
        for (int z = -ring; z <= ring; ++z) {
          if (std::max({std::abs(x), std::abs(y), std::abs(z)}) != ring) continue;
          const CellAt at{middle[0] + x, middle[1] + y, middle[2] + z};
          if (!has(at)) continue;
          const std::size_t c = index_of(at);
          for (std::uint32_t n = first_[c]; n < first_[c + 1]; ++n)
            near.push_back({(rest_.points[points_[n]] - p).norm(), points_[n]});
        }
  }

  CellAt cell_at(const Vec3& p) const {
    const auto along = [&](int a) {
      return static_cast<int>(std::clamp(std::floor((p[a] - lo_[a]) / cell_m_), -1e6, 1e6));
    };
    return {along(0), along(1), along(2)};
  }
  bool has(const CellAt& at) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (at[a] < 0 || at[a] >= count_[a]) return false;
    return true;
  }
  std::size_t index_of(const CellAt& at) const {
    const auto of = [&](std::size_t a) {
      return static_cast<std::size_t>(std::clamp(at[a], 0, count_[a] - 1));
    };
    return (of(0) * static_cast<std::size_t>(count_[1]) + of(1)) *
               static_cast<std::size_t>(count_[2]) +
           of(2);
  }

  Surface rest_;
  std::vector<ShadedMesh::Shade> shades_;
  Vec3 lo_ = Vec3::Zero();
  double cell_m_ = kCell_m;
  CellAt count_{1, 1, 1};
  std::vector<std::uint32_t> first_;   ///< by cell: where its points begin in `points_`
  std::vector<std::uint32_t> points_;  ///< cell by cell
};

ShadedMesh cut_light(const TriMesh& rest, const RestLight& light, const TriMesh& cut,
                     CutLight& known) {
  ShadedMesh out;
  const bool anew =
      known.triangles != cut.triangles || known.of_vertices.size() != cut.vertices.size();
  if (anew) {
    if (!known.near || known.rest_vertices != rest.vertices) {
      Surface at_rest = make_surface(rest);
      if (light.shades.empty() || at_rest.points.size() != light.shades.size()) return out;
      known.near = std::make_shared<const LightByCell>(std::move(at_rest), light.shades);
      known.rest_vertices = rest.vertices;
    }
    known.triangles = cut.triangles;
    known.of_vertices.clear();
    std::vector<LightByCell::Near> room;
    for (const Vec3& p : cut.vertices)
      known.of_vertices.push_back(is_finite(p) ? known.near->at(p, room)
                                               : ShadedMesh::Shade{255, 128, 128, 128});
  }
  std::vector<std::uint32_t> place;
  const Surface s = welded(cut, &place);
  std::vector<ShadedMesh::Shade> shades(s.points.size());
  for (std::size_t v = 0; v < place.size(); ++v)
    if (place[v] < shades.size()) shades[place[v]] = known.of_vertices[v];
  if (anew) known.closed = encloses_volume(s);
  out = plain_shaded(cut);  // its corners, triangle by triangle: the edges of a cut stay sharp
  for (std::size_t i = 0; i < s.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3 && 3 * i + k < out.shades.size(); ++k)
      out.shades[3 * i + k] = shades[s.triangles[i][k]];
  out.closed = known.closed;
  return out;
}

ShadedMesh shown_light(const TriMesh& rest, RestLight& light, const TriMesh& shown) {
  ShadedMesh out = moved_light(rest, light, shown);
  return out.positions.empty() ? cut_light(rest, light, shown, light.cut) : out;
}

}  // namespace osteon
