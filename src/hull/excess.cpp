#include "excess.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "osteon/mesh/longest_edge.h"

namespace osteon::hull {
namespace {

using Corners = std::array<Vec3, 3>;

class Sampler {
 public:
  Sampler(HeightGrid& grid, double spacing) : grid_(grid), spacing2_(spacing * spacing) {}

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
    result.moment += height * height * 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    if (height <= result.height) return;
    result.height = height;
    result.at = p;
  }

  HeightGrid& grid_;
  double spacing2_;
};

}  // namespace

Excess excess(const Hull& hull, HeightGrid& grid, double spacing) {
  Sampler sampler(grid, spacing);
  for (const Triangle& t : hull.triangles)
    sampler.add({hull.vertices[t[0]], hull.vertices[t[1]], hull.vertices[t[2]]});
  return sampler.result;
}

}  // namespace osteon::hull
