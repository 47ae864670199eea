#include <algorithm>
#include <cmath>
#include <map>

#include "osteon/tissue/sheet_balance.h"

namespace osteon {
namespace {

// Weights of the triangle's corners at `p`; all are at least 0 within it.
std::array<double, 3> weights_at(const SplitSheet& split, const Triangle& t, const SheetPoint& p) {
  const SheetPoint &a = split.point[t[0]], &b = split.point[t[1]], &c = split.point[t[2]];
  const auto cross = [](const SheetPoint& u, const SheetPoint& v) {
    return u.x() * v.y() - u.y() * v.x();
  };
  const double twice = cross(b - a, c - a);
  return {cross(b - p, c - p) / twice, cross(c - p, a - p) / twice, cross(a - p, b - p) / twice};
}

// Triangles whose boxes meet the disc's.
std::vector<std::uint32_t> near(const SplitSheet& split, const SheetDisc& disc, double& area) {
  std::vector<std::uint32_t> out;
  area = 0;
  for (std::uint32_t t = 0; t < split.triangles.size(); ++t) {
    const Triangle& tri = split.triangles[t];
    const SheetPoint &a = split.point[tri[0]], &b = split.point[tri[1]], &c = split.point[tri[2]];
    const SheetPoint lo = a.cwiseMin(b).cwiseMin(c), hi = a.cwiseMax(b).cwiseMax(c);
    if (!((disc.p - hi).maxCoeff() <= disc.radius_m && (lo - disc.p).maxCoeff() <= disc.radius_m))
      continue;
    out.push_back(t);
    area += 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
  }
  return out;
}

}  // namespace

// The disc is sampled at the nodes of a lattice of equilateral triangles that lie on it: 91 points
// or more, closer together than the sheet's vertices, each for the same area. They follow from
// whole numbers, so that every machine has the same ones.
SheetLoad load_on(const SplitSheet& split, const SheetDisc& disc) {
  constexpr double kHalfSqrt3 = 0.8660254037844386;
  double area = 0;
  const std::vector<std::uint32_t> triangles = near(split, disc, area);
  if (triangles.empty() || !(disc.radius_m > 0)) return {};
  const double edge = std::sqrt(2 * area / static_cast<double>(triangles.size()));
  const int rings = static_cast<int>(std::clamp(2 * disc.radius_m / edge, 5.0, 40.0));
  std::map<std::uint32_t, double> sum;
  int points = 0;
  for (int j = -2 * rings; j <= 2 * rings; ++j)
    for (int i = -2 * rings; i <= 2 * rings; ++i) {
      if (i * i + i * j + j * j > rings * rings) continue;
      const SheetPoint q = disc.p + disc.radius_m / rings * SheetPoint(i + 0.5 * j, kHalfSqrt3 * j);
      bool found = false;
      for (std::size_t n = 0; n < triangles.size() && !found; ++n) {
        const Triangle& t = split.triangles[triangles[n]];
        const auto w = weights_at(split, t, q);
        found = w[0] >= 0 && w[1] >= 0 && w[2] >= 0;
        for (std::size_t k = 0; found && k < 3; ++k) sum[t[k]] += w[k];
      }
      if (!found) return {};
      ++points;
    }
  SheetLoad out;
  for (const auto& [copy, weight] : sum) {
    out.copy.push_back(copy);
    out.weight.push_back(weight / points);
  }
  return out;
}

}  // namespace osteon
