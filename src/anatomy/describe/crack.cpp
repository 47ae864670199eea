// The rough slit that findings cut with.
#include <cmath>
#include <cstdint>

#include "describe/shape.h"

namespace osteon {
namespace {

/// Of a corner of the grid of bumps, in [-1, 1): whole numbers, so the same on every machine.
double corner_height(std::int64_t i, std::int64_t j) {
  std::uint64_t h = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15u +
                    static_cast<std::uint64_t>(j) * 0xbf58476d1ce4e5b9u;
  h ^= h >> 31;
  h *= 0x94d049bb133111ebu;
  h ^= h >> 29;
  return static_cast<double>(h >> 11) * (2.0 / 9007199254740992.0) - 1;
}

double eased(double t) { return t * t * (3 - 2 * t); }

/// Value noise (K. Perlin's term: heights at the corners of a grid, eased in between), in [-1, 1].
/// Its slope along either axis is at most 3.
double bumps(double u, double v) {
  const double iu = std::floor(u), iv = std::floor(v);
  const auto i = static_cast<std::int64_t>(iu), j = static_cast<std::int64_t>(iv);
  const double s = eased(u - iu), t = eased(v - iv);
  const double low = corner_height(i, j) + s * (corner_height(i + 1, j) - corner_height(i, j));
  const double high =
      corner_height(i, j + 1) + s * (corner_height(i + 1, j + 1) - corner_height(i, j + 1));
  return low + t * (high - low);
}

}  // namespace

double distance(const Crack& c, const Vec3& p) {
  const Vec3 q = p - c.point;
  // Two directions across the normal, from the axis that it leans to least.
  int least = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(c.normal[k]) < std::abs(c.normal[least])) least = k;
  const Vec3 axis = Vec3::Unit(least);
  const Vec3 cross = c.normal.cross(axis);
  const Vec3 e = cross / std::sqrt(cross.dot(cross));
  const Vec3 f = c.normal.cross(e);
  const double off = c.normal.dot(q) - c.rough * bumps(e.dot(q) / c.grain, f.dot(q) / c.grain);
  const double slope2 = 18 * (c.rough / c.grain) * (c.rough / c.grain);
  return (std::abs(off) - 0.5 * c.gap) / std::sqrt(1 + slope2);
}

}  // namespace osteon
