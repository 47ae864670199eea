// Builds the hull of points read from bytes and has it checked by the independent validator. The
// first byte says how bytes become coordinates: grid cells (flat, equal and collinear points
// abound), grid cells far from the origin or nudged by one bit, or raw doubles. Points of a grid
// may come with a crowd of others between them, so many that some are sorted out at first: the
// corners must be the same.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "osteon/hull/hull.h"
#include "osteon/hull/validate.h"

namespace {

using osteon::Vec3;

std::vector<Vec3> grid_points(const std::uint8_t* data, std::size_t size, int mode) {
  std::vector<Vec3> points;
  const int cells = (mode & 4) ? 255 : 7;
  for (std::size_t i = 0; i + 3 <= size; i += 3) {
    Vec3 p(data[i] & cells, data[i + 1] & cells, data[i + 2] & cells);
    if (mode & 8) p = 0.1 * p + Vec3(1e3, -3e3, 7);
    if ((mode & 16) && (data[i] & 128)) p.z() = std::nextafter(p.z(), 1e9);
    points.push_back(p);
  }
  return points;
}

std::vector<Vec3> raw_points(const std::uint8_t* data, std::size_t size) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i + sizeof(double) * 3 <= size; i += sizeof(double) * 3) {
    double xyz[3];
    std::memcpy(xyz, data + i, sizeof xyz);
    points.emplace_back(xyz[0], xyz[1], xyz[2]);
  }
  return points;
}

/// Means of two, which are exact on a grid, before the points themselves.
std::vector<Vec3> crowd_with(const std::vector<Vec3>& points) {
  constexpr std::size_t kCrowd = 5100;
  std::vector<Vec3> all;
  for (std::size_t i = 0; !points.empty() && all.size() < kCrowd; ++i) {
    const Vec3& p = points[i % points.size()];
    const Vec3& q = points[(7 * i + i / points.size() + 1) % points.size()];
    all.push_back(0.5 * p + 0.5 * q);
  }
  all.insert(all.end(), points.begin(), points.end());
  return all;
}

std::vector<Vec3> sorted(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return points;
}

bool has_non_finite(const std::vector<Vec3>& points) {
  for (const Vec3& p : points) {
    if (!osteon::is_finite(p)) return true;
  }
  return false;
}

double magnitude(const std::vector<Vec3>& points) {
  double largest = 0;
  for (const Vec3& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

/// Sizes at which the planes, volume and centroid can be told in doubles at all; beyond, only the
/// corners are exact.
bool measurable(const std::vector<Vec3>& points) {
  for (const Vec3& p : points) {
    for (int k = 0; k < 3; ++k) {
      if (p[k] != 0 && (std::abs(p[k]) < 1e-50 || std::abs(p[k]) > 1e50)) return false;
    }
  }
  return true;
}

void stop(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > 4096) return 0;
  const int mode = data[0];
  const std::vector<Vec3> points =
      (mode & 3) == 0 ? raw_points(data + 1, size - 1) : grid_points(data + 1, size - 1, mode);
  const osteon::HullOutcome outcome = osteon::build_hull(points);
  if (outcome.hull && has_non_finite(points)) stop("a hull of points that are not finite");
  if ((mode & 32) && (mode & 3) && !(mode & (8 | 16))) {
    const osteon::HullOutcome crowded = osteon::build_hull(crowd_with(points));
    if (crowded.hull.has_value() != outcome.hull.has_value()) stop("a crowd changes the outcome");
    if (outcome.hull && sorted(crowded.hull->vertices) != sorted(outcome.hull->vertices))
      stop("a crowd changes the corners");
  }
  if (!outcome.hull || !measurable(points)) return 0;
  const double tolerance_m = 1e-12 * magnitude(points);
  for (const std::string& problem : osteon::validate_hull(*outcome.hull, points, tolerance_m)) {
    stop(problem.c_str());
  }
  return 0;
}
