#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "osteon/base/random.h"
#include "osteon/base/types.h"

// Point sets for the tests; all deterministic.

namespace osteon::test {

using Points = std::vector<Vec3>;

inline Points box_corners() {
  Points points;
  for (int k = 0; k < 8; ++k) points.emplace_back(k & 1, (k >> 1) & 1, (k >> 2) & 1);
  return points;
}

/// n^3 points on a cubic lattice.
inline Points lattice(int n) {
  Points points;
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      for (int z = 0; z < n; ++z) points.emplace_back(x, y, z);
    }
  }
  return points;
}

/// Integer points of the circle of radius 65, exactly cocircular (36 of them).
inline Points lattice_circle() {
  Points points;
  for (int x = -65; x <= 65; ++x) {
    for (int y = -65; y <= 65; ++y) {
      if (x * x + y * y == 65 * 65) points.emplace_back(x, y, 0);
    }
  }
  return points;
}

/// Integer points of the sphere x^2 + y^2 + z^2 = r2: its facets have many cocircular corners.
inline Points lattice_sphere(int r2) {
  Points points;
  const int r = static_cast<int>(std::sqrt(r2)) + 1;
  for (int x = -r; x <= r; ++x) {
    for (int y = -r; y <= r; ++y) {
      for (int z = -r; z <= r; ++z) {
        if (x * x + y * y + z * z == r2) points.emplace_back(x, y, z);
      }
    }
  }
  return points;
}

inline Points sphere(Random& random, std::size_t n) {
  Points points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(random.direction());
  return points;
}

inline Points ball(Random& random, std::size_t n) {
  Points points;
  while (points.size() < n) {
    const double x = random.uniform(-1, 1);
    const double y = random.uniform(-1, 1);
    const double z = random.uniform(-1, 1);
    if (x * x + y * y + z * z <= 1) points.emplace_back(x, y, z);
  }
  return points;
}

inline Points integer_points(Random& random, std::size_t n, int range) {
  Points points;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = std::floor(random.uniform(0, range));
    const double y = std::floor(random.uniform(0, range));
    const double z = std::floor(random.uniform(0, range));
    points.emplace_back(x, y, z);
  }
  return points;
}

inline void shuffle(Random& random, Points& points) {
  for (std::size_t i = points.size(); i > 1; --i) {
    std::swap(points[i - 1], points[random.next() % i]);
  }
}

}  // namespace osteon::test
