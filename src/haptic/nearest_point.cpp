#include "nearest_point.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// Squared sine below which a plane counts as parallel to those before it.
constexpr double kParallel = 1e-12;
constexpr int kMaxSteps = 64;

struct Basis {
  std::uint32_t count = 0;
  std::array<std::uint32_t, 3> plane{};
};

struct Projection {
  bool sound = false;
  Vec3 x = Vec3::Zero();
  std::array<double, 3> weight{};
};

// Nearest point to `wanted` on all planes of the basis at once: x = wanted + N^T w with
// (N N^T) w = c - N wanted, by Cholesky. Sound when every weight pushes outwards.
Projection project(std::span<const FreeHalfSpace> planes, const Basis& basis, const Vec3& wanted) {
  Projection out;
  std::array<std::array<double, 3>, 3> l{};
  std::array<double, 3> y{};
  const std::size_t m = basis.count;
  for (std::size_t i = 0; i < m; ++i) {
    const FreeHalfSpace& pi = planes[basis.plane[i]];
    double rhs = pi.c - pi.n.dot(wanted);
    for (std::size_t j = 0; j <= i; ++j) {
      double g = pi.n.dot(planes[basis.plane[j]].n);
      for (std::size_t k = 0; k < j; ++k) g -= l[i][k] * l[j][k];
      if (j < i) {
        l[i][j] = g / l[j][j];
        rhs -= l[i][j] * y[j];
      } else {
        if (g < kParallel) return out;
        l[i][i] = std::sqrt(g);
      }
    }
    y[i] = rhs / l[i][i];
  }
  out.x = wanted;
  for (std::size_t i = m; i-- > 0;) {
    double w = y[i];
    for (std::size_t k = i + 1; k < m; ++k) w -= l[k][i] * out.weight[k];
    out.weight[i] = w / l[i][i];
    if (!(out.weight[i] > 0)) return out;
    out.x += out.weight[i] * planes[basis.plane[i]].n;
  }
  out.sound = true;
  return out;
}

double shortfall(const FreeHalfSpace& plane, const Vec3& x) { return plane.c - plane.n.dot(x); }

bool holds(std::span<const FreeHalfSpace> planes, const Basis& set, const Vec3& x) {
  for (std::uint32_t i = 0; i < set.count; ++i)
    if (shortfall(planes[set.plane[i]], x) > kPlaneTolerance) return false;
  return true;
}

// Members of `from` chosen by the bits of `mask`, then `extra`.
Basis subset(const Basis& from, unsigned mask, std::uint32_t extra) {
  Basis out;
  for (std::uint32_t i = 0; i < from.count; ++i)
    if (mask & (1u << i)) out.plane[out.count++] = from.plane[i];
  out.plane[out.count++] = extra;
  return out;
}

// Puts `plane` into the basis: the one subset with it whose projection lies in all of them. The
// optimum over the old basis and the new plane has at most three active planes, `plane` among them.
bool enter(std::span<const FreeHalfSpace> planes, std::uint32_t plane, const Vec3& wanted,
           Basis& basis, Projection& at) {
  static constexpr std::array<unsigned, 7> kBySize{0b000, 0b001, 0b010, 0b100, 0b011, 0b101, 0b110};
  for (const unsigned mask : kBySize) {
    if (mask >= (1u << basis.count)) continue;
    const Basis trial = subset(basis, mask, plane);
    const Projection p = project(planes, trial, wanted);
    if (!p.sound || !holds(planes, basis, p.x)) continue;
    basis = trial;
    at = p;
    return true;
  }
  return false;
}

}  // namespace

NearestPoint nearest_point(std::span<const FreeHalfSpace> planes, const Vec3& wanted) {
  NearestPoint out;
  Basis basis;
  Projection at;
  at.x = wanted;
  for (int step = 0; step < kMaxSteps; ++step) {
    std::uint32_t worst = 0;
    double worst_shortfall = kPlaneTolerance;
    for (std::uint32_t i = 0; i < planes.size(); ++i) {
      const double s = shortfall(planes[i], at.x);
      if (s > worst_shortfall) {
        worst_shortfall = s;
        worst = i;
      }
    }
    if (worst_shortfall <= kPlaneTolerance) {
      out.found = true;
      out.x = at.x;
      out.active_count = basis.count;
      out.active = basis.plane;
      out.weight = at.weight;
      return out;
    }
    if (!enter(planes, worst, wanted, basis, at)) return out;
  }
  return out;
}

}  // namespace osteon
