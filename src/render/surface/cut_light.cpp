#include "surface/cut_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "surface/shapes.h"
#include "surface/surface.h"

namespace osteon {
namespace {

constexpr double kCell_m = 0.001;      // about as far apart as vertices are
constexpr int kMostCells = 6;          // so deep a cut takes light from its surface
constexpr double kEven_m = 0.0007;     // farther than the nearest: light is taken of those too
constexpr double kAsItWas_m = 0.0003;  // less deep is the surface as it was
constexpr double kDarkAt_m = 0.008;    // so deep a cut sees a quarter of the sky
constexpr std::uint8_t kOpened = 100;  // of the cavity of a cut face

using CellAt = std::array<int, 3>;

CellAt cell_at(const Vec3& p) {
  const auto along = [](double x) { return static_cast<int>(std::floor(x / kCell_m)); };
  return {along(p.x()), along(p.y()), along(p.z())};
}

std::uint64_t key_of(const CellAt& at) {
  std::uint64_t key = 0;
  for (const int a : at) key = key << 21 | (static_cast<std::uint64_t>(a) & 0x1fffff);
  return key;
}

/// The surface at rest by cells of room.
class LightByCell {
 public:
  LightByCell(const Surface& rest, const std::vector<ShadedMesh::Shade>& shades)
      : rest_(rest), shades_(shades) {
    for (std::uint32_t k = 0; k < rest.points.size(); ++k)
      cells_[key_of(cell_at(rest.points[k]))].push_back(k);
  }

  ShadedMesh::Shade at(const Vec3& p) const {
    ShadedMesh::Shade out{255, 128, 128, 128};
    const std::vector<Near> near = near_to(p);
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
  struct Near {
    double away_m;
    std::uint32_t point;
  };

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
  std::vector<Near> near_to(const Vec3& p) const {
    std::vector<Near> near;
    const CellAt middle = cell_at(p);
    for (int ring = 0; ring <= kMostCells; ++ring) {
      const bool last = !near.empty();  // one more ring: what is in it may be nearer
      add_ring(p, middle, ring, near);
      if (last) break;
    }
    std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) {
      return std::pair(a.away_m, a.point) < std::pair(b.away_m, b.point);
    });
    return near;
  }

  void add_ring(const Vec3& p, const CellAt& middle, int ring, std::vector<Near>& near) const {
    for (int x = -ring; x <= ring; ++x)
      for (int y = -ring; y <= ring; ++y)
        for (int z = -ring; z <= ring; ++z) {
          if (std::max({std::abs(x), std::abs(y), std::abs(z)}) != ring) continue;
          const auto cell = cells_.find(key_of({middle[0] + x, middle[1] + y, middle[2] + z}));
          if (cell == cells_.end()) continue;
          for (const std::uint32_t k : cell->second)
            near.push_back({(rest_.points[k] - p).norm(), k});
        }
  }

  const Surface& rest_;
  const std::vector<ShadedMesh::Shade>& shades_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace

ShadedMesh cut_light(const TriMesh& rest, const RestLight& light, const TriMesh& cut,
                     CutLight& known) {
  ShadedMesh out;
  const bool anew =
      known.triangles != cut.triangles || known.of_vertices.size() != cut.vertices.size();
  if (anew) {
    const Surface at_rest = make_surface(rest);
    if (light.shades.empty() || at_rest.points.size() != light.shades.size()) return out;
    const LightByCell cells(at_rest, light.shades);
    known = {cut.triangles, {}, false};
    for (const Vec3& p : cut.vertices)
      known.of_vertices.push_back(is_finite(p) ? cells.at(p)
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
