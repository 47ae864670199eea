#include "excess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "osteon/mesh/longest_edge.h"

namespace osteon::hull {
namespace {

using Corners = std::array<Vec3, 3>;

class Sampler {
 public:
  Sampler(HeightGrid& grid, const PlaceValue& value, double spacing)
      : grid_(grid), value_(value), spacing2_(spacing * spacing) {}

  void add(const Corners& t) {
    const auto [longest, length2] = longest_edge(t);
    if (length2 <= spacing2_) return sample(t);
    // Heights change by no more than the way: a triangle deep inside has nothing to say. The grid's
    // own heights are good to a part of a cell.
    const double reach = std::sqrt(length2);
    if (grid_.at((t[0] + t[1] + t[2]) / 3) + reach < -grid_.cell()) return;
    const Vec3& a = t[longest];
    const Vec3& b = t[(longest + 1) % 3];
    const Vec3& c = t[(longest + 2) % 3];
    const Vec3 middle = 0.5 * (a + b);
    add({a, middle, c});
    add({middle, b, c});
  }

  Excess result;

 private:
  void sample(const Corners& t) {
    const Vec3 p = (t[0] + t[1] + t[2]) / 3;
    const double height = grid_.at(p);
    if (height <= 0) return;
    const double need = height * value_.at(p);
    result.moment += need * need * 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    if (need <= result.need) return;
    result.height = height;
    result.need = need;
    result.at = p;
  }

  HeightGrid& grid_;
  const PlaceValue& value_;
  double spacing2_;
};

// Finds the place of most need by branch and bound: over a triangle the height is at most that of
// its middle and the way to its farthest corner.
class PeakSearch {
 public:
  PeakSearch(HeightGrid& grid, const PlaceValue& value, double floor, double enough, Excess& best)
      : grid_(grid), value_(value), enough_(enough), floor_(floor), best_(best) {}

  void search(const Corners& t) {
    if (best_.need > enough_) return;
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
    double way = 0;
    for (const Vec3& corner : t) way = std::max(way, (corner - middle).norm());
    const double most = value_.most(t);
    // The grid's heights are good to a part of a cell, and quicker.
    if (most * (grid_.at(middle) + 0.5 * grid_.cell() + way) <= bar()) return;
    const ClosestPoint found = grid_.exact().closest(middle, last_);
    last_ = found.triangle;
    const double height = found.signed_distance;
    note(middle, height);
    if (most * (height + way) <= bar()) return;
    const std::size_t longest = longest_edge(t).from;
    const Vec3& a = t[longest];
    const Vec3& b = t[(longest + 1) % 3];
    const Vec3& c = t[(longest + 2) % 3];
    const Vec3 half = 0.5 * (a + b);
    search({a, half, c});
    search({half, b, c});
  }

 private:
  /// Above it something is still looked for.
  double bar() const {
    return std::max(floor_, best_.need) + std::max(kPeakError_m, 0.05 * best_.need);
  }
  void note(const Vec3& p, double height) {
    const double need = height * value_.at(p);
    if (need <= best_.need) return;
    best_.need = need;
    best_.height = height;
    best_.at = p;
  }

  HeightGrid& grid_;
  const PlaceValue& value_;
  double enough_;
  double floor_;
  Excess& best_;
  std::uint32_t last_ = 0;  ///< triangle of the mesh near the last place
};

}  // namespace

Excess excess(const Hull& hull, HeightGrid& grid, const PlaceValue& value, double spacing) {
  Sampler sampler(grid, value, spacing);
  for (const Triangle& t : hull.triangles)
    sampler.add({hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]});
  return sampler.result;
}

Excess exact_excess(const Hull& hull, HeightGrid& grid, const PlaceValue& value,
                    const Excess& sampled, double floor, double enough) {
  Excess out = sampled;
  out.height = grid.exact().closest(out.at).signed_distance;
  out.need = out.need > 0 ? out.height * value.at(out.at) : 0;
  PeakSearch peak(grid, value, floor, enough, out);
  for (const Triangle& t : hull.triangles)
    peak.search({hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]});
  return out;
}

}  // namespace osteon::hull
