#include "nearest_point.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// Squared sine below which a plane counts as parallel to those before it.
constexpr double kParallel = 1e-12;

double shortfall(const FreeHalfSpace& plane, const Vec3& x) { return plane.c - plane.n.dot(x); }

}  // namespace

NearestSearch::NearestSearch(std::span<const FreeHalfSpace> planes, const Vec3& wanted)
    : planes_(planes), wanted_(wanted) {
  at_.x = wanted;
}

// Nearest point to `wanted` on all planes of the basis at once: x = wanted + N^T w with
// (N N^T) w = c - N wanted, by Cholesky. Sound when every weight pushes outwards.
NearestSearch::Projection NearestSearch::project(const Basis& basis) const {
  Projection out;
  std::array<std::array<double, 3>, 3> l{};
  std::array<double, 3> y{};
  const std::size_t m = basis.count;
  for (std::size_t i = 0; i < m; ++i) {
    const FreeHalfSpace& pi = planes_[basis.plane[i]];
    double rhs = pi.c - pi.n.dot(wanted_);
    for (std::size_t j = 0; j <= i; ++j) {
      double g = pi.n.dot(planes_[basis.plane[j]].n);
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
  out.x = wanted_;
  for (std::size_t i = m; i-- > 0;) {
    double w = y[i];
    for (std::size_t k = i + 1; k < m; ++k) w -= l[k][i] * out.weight[k];
    out.weight[i] = w / l[i][i];
    if (!(out.weight[i] > 0)) return out;
    out.x += out.weight[i] * planes_[basis.plane[i]].n;
  }
  out.sound = true;
  return out;
}

bool NearestSearch::holds(const Basis& set, const Vec3& x) const {
  for (std::uint32_t i = 0; i < set.count; ++i)
    if (shortfall(planes_[set.plane[i]], x) > kPlaneTolerance) return false;
  return true;
}

// Members of `from` chosen by the bits of `mask`, then `extra`.
NearestSearch::Basis NearestSearch::subset(const Basis& from, unsigned mask, std::uint32_t extra) {
  Basis out;
  for (std::uint32_t i = 0; i < from.count; ++i)
    if (mask & (1u << i)) out.plane[out.count++] = from.plane[i];
  out.plane[out.count++] = extra;
  return out;
}

// Puts `plane` into the basis: the one subset with it whose projection lies in all of them. The
// optimum over the old basis and the new plane has at most three active planes, `plane` among them.
bool NearestSearch::enter(std::uint32_t plane) {
  static constexpr std::array<unsigned, 7> kBySize{0b000, 0b001, 0b010, 0b100, 0b011, 0b101, 0b110};
  for (const unsigned mask : kBySize) {
    if (mask >= (1u << basis_.count)) continue;
    const Basis trial = subset(basis_, mask, plane);
    const Projection p = project(trial);
    if (!p.sound || !holds(basis_, p.x)) continue;
    basis_ = trial;
    at_ = p;
    return true;
  }
  return false;
}

NearestPoint NearestSearch::result() const {
  return {true, at_.x, basis_.count, basis_.plane, at_.weight};
}

NearestPoint nearest_point(std::span<const FreeHalfSpace> planes, const Vec3& wanted) {
  NearestSearch search(planes, wanted);
  for (int step = 0; step < NearestSearch::kMaxSteps; ++step) {
    std::uint32_t worst = 0;
    double worst_shortfall = kPlaneTolerance;
    for (std::uint32_t i = 0; i < planes.size(); ++i) {
      const double s = shortfall(planes[i], search.at());
      if (s > worst_shortfall) {
        worst_shortfall = s;
        worst = i;
      }
    }
    if (worst_shortfall <= kPlaneTolerance) return search.result();
    if (!search.enter(worst)) return {};
  }
  return {};
}

}  // namespace osteon
