#pragma once

// Simplex method on the dual of
//   depth:  minimise t    subject to n_i.x - t <= d_i   (dual: min d.y, sum y n = 0, sum y = 1)
//   corner: maximise c.x  subject to n_i.x <= d_i       (dual: min d.y, sum y n = c)
// with y >= 0. A basis is four (three) rows; its rows hold with equality at the current vertex x.
// The entering row is the one that x violates most, the leaving row keeps y >= 0 (ratio test).
// The basis is factored anew at each pivot, so no error is carried along.
//
// `Rows` gives:
//   Row row(std::uint32_t id) const
//   Excess most_exceeded(x, floor, basis_ids), Excess first_exceeded(x, floor): by n.x - d
//   double scale() const: size of the bodies, m

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "block_scan.h"
#include "osteon/base/types.h"
#include "osteon/collide/lp_contact.h"

namespace osteon {

/// A row of the programme: n.x <= d, in the local frame of the query.
struct Row {
  Vec3 n = Vec3::Zero();
  double d = 0;
};

inline constexpr int kPivotLimit = 400;
inline constexpr int kStallLimit = 30;         // pivots without progress before Bland's rule
inline constexpr double kFeasibility = 1e-12;  // of x, as a share of the scale
inline constexpr double kWeightSlack = 1e-11;  // of y
inline constexpr double kLeastPivot = 1e-12;

/// Leaving row: Harris' two passes (the largest pivot among the rows whose ratio is least within
/// the slack), or the lowest id of the least ratio under Bland's rule. -1: the dual is unbounded.
template <std::size_t N>
int leaving_row(const std::array<double, N>& y, const std::array<double, N>& alpha,
                const std::array<std::uint32_t, N>& ids, bool bland) {
  const double slack = bland ? 0 : kWeightSlack;
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < N; ++k)
    if (alpha[k] > kLeastPivot) limit = std::min(limit, (std::max(y[k], 0.0) + slack) / alpha[k]);
  int leaving = -1;
  for (std::size_t k = 0; k < N; ++k) {
    if (!(alpha[k] > kLeastPivot) || std::max(y[k], 0.0) / alpha[k] > limit) continue;
    const auto l = static_cast<std::size_t>(leaving);
    if (leaving < 0 || (bland ? ids[k] < ids[l] : alpha[k] > alpha[l]))
      leaving = static_cast<int>(k);
  }
  return leaving;
}

/// Basis of the depth programme: weights y are the barycentric coordinates of the origin in the
/// tetrahedron of the four normals.
struct DepthBasis {
  static constexpr std::size_t kRows = 4;
  std::array<std::uint32_t, 4> ids{};
  std::array<Row, 4> rows{};
  std::array<Vec3, 4> g;  // gradients of the barycentric coordinates
  std::array<double, 4> y{};
  Vec3 x = Vec3::Zero();
  double t = 0;

  bool factor() {
    const Vec3 e1 = rows[1].n - rows[0].n, e2 = rows[2].n - rows[0].n, e3 = rows[3].n - rows[0].n;
    const Vec3 c1 = e2.cross(e3);
    const double det = e1.dot(c1);
    if (!(std::abs(det) > 1e-40)) return false;
    const double inverse = 1 / det;
    g[1] = c1 * inverse;
    g[2] = e3.cross(e1) * inverse;
    g[3] = e1.cross(e2) * inverse;
    g[0] = -(g[1] + g[2] + g[3]);
    y = weights_of(Vec3::Zero());
    return true;
  }
  std::array<double, 4> weights_of(const Vec3& n) const {
    const Vec3 from = n - rows[0].n;
    const double w1 = g[1].dot(from), w2 = g[2].dot(from), w3 = g[3].dot(from);
    return {1 - (w1 + w2 + w3), w1, w2, w3};
  }
  void solve() {
    const double d0 = rows[0].d;
    x = g[1] * (rows[1].d - d0) + g[2] * (rows[2].d - d0) + g[3] * (rows[3].d - d0);
    refine();
    t = rows[0].n.dot(x) - d0;
  }
  double objective() const { return -t; }
  double level() const { return t; }

 private:
  // One step of iterative refinement: near-parallel normals make a badly conditioned basis.
  void refine() {
    const double t0 = rows[0].n.dot(x) - rows[0].d;
    Vec3 step = Vec3::Zero();
    for (std::size_t k = 1; k < 4; ++k) step += g[k] * (rows[k].n.dot(x) - rows[k].d - t0);
    x -= step;
  }
};

/// Basis of the collision test: weights y are the coordinates of c in the cone of three normals.
struct CornerBasis {
  static constexpr std::size_t kRows = 3;
  std::array<std::uint32_t, 3> ids{};
  std::array<Row, 3> rows{};
  std::array<Vec3, 3> g;  // dual vectors of the normals
  std::array<double, 3> y{};
  Vec3 x = Vec3::Zero();

  /// Objective of the paper: maximise x + y + z.
  static Vec3 objective_normal() { return Vec3::Ones(); }

  bool factor() {
    const Vec3 c0 = rows[1].n.cross(rows[2].n);
    const double det = rows[0].n.dot(c0);
    if (!(std::abs(det) > 1e-40)) return false;
    const double inverse = 1 / det;
    g[0] = c0 * inverse;
    g[1] = rows[2].n.cross(rows[0].n) * inverse;
    g[2] = rows[0].n.cross(rows[1].n) * inverse;
    y = weights_of(objective_normal());
    return true;
  }
  std::array<double, 3> weights_of(const Vec3& n) const {
    return {g[0].dot(n), g[1].dot(n), g[2].dot(n)};
  }
  void solve() {
    x = g[0] * rows[0].d + g[1] * rows[1].d + g[2] * rows[2].d;
    Vec3 step = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) step += g[k] * (rows[k].n.dot(x) - rows[k].d);
    x -= step;
  }
  double objective() const { return x.sum(); }
  double level() const { return 0; }
};

template <class Basis, class Rows>
bool load_basis(Basis& basis, const Rows& rows,
                const std::array<std::uint32_t, Basis::kRows>& ids) {
  basis.ids = ids;
  for (std::size_t k = 0; k < Basis::kRows; ++k) basis.rows[k] = rows.row(ids[k]);
  return basis.factor();
}

/// Whether the loaded basis has weights that the method may start from.
template <class Basis>
bool dual_feasible(const Basis& basis) {
  return std::all_of(basis.y.begin(), basis.y.end(), [](double y) { return y >= -kWeightSlack; });
}

struct SimplexEnd {
  LpStatus status = LpStatus::kNumerical;
  int pivots = 0;
  double residual = 0;
};

/// Puts row `id` into the basis in place of the one that the ratio test names. kOptimal: done.
template <class Basis, class Rows>
LpStatus pivot(Basis& basis, const Rows& rows, std::uint32_t id, bool bland) {
  const Row entering = rows.row(id);
  const int leaving = leaving_row(basis.y, basis.weights_of(entering.n), basis.ids, bland);
  if (leaving < 0) return LpStatus::kUnbounded;
  const auto l = static_cast<std::size_t>(leaving);
  basis.ids[l] = id;
  basis.rows[l] = entering;
  if (!basis.factor()) return LpStatus::kNumerical;
  basis.solve();
  return LpStatus::kOptimal;
}

/// Brings rows of `wanted` into a dual-feasible, solved basis as far as they are violated: a start
/// near an old basis that turning has made infeasible.
template <class Basis, class Rows>
LpStatus crash(Basis& basis, const Rows& rows, std::span<const std::uint32_t> wanted, int& pivots) {
  constexpr int kTries = 12;
  for (int i = 0; i < kTries; ++i) {
    Excess worst{basis.level() + kFeasibility * rows.scale(), Excess::kNone};
    for (const std::uint32_t id : wanted) {
      const Row r = rows.row(id);
      const double value = r.n.dot(basis.x) - r.d;
      if (value > worst.value) worst = {value, id};
    }
    if (worst.plane == Excess::kNone) break;
    ++pivots;
    const LpStatus status = pivot(basis, rows, worst.plane, false);
    if (status != LpStatus::kOptimal) return status;
  }
  return LpStatus::kOptimal;
}

/// Pivots on rows that are likely to be violated most while such are found by a short look: most of
/// the way from a cold start.
template <class Basis, class Rows>
LpStatus approach(Basis& basis, const Rows& rows, int& pivots) {
  constexpr int kTries = 40;
  for (int i = 0; i < kTries && is_finite(basis.x); ++i) {
    const double level = basis.level();
    const Excess likely = rows.likely_exceeded(basis.x, level + kFeasibility * rows.scale());
    if (likely.plane == Excess::kNone ||
        std::find(basis.ids.begin(), basis.ids.end(), likely.plane) != basis.ids.end())
      break;
    ++pivots;
    const LpStatus status = pivot(basis, rows, likely.plane, false);
    if (status != LpStatus::kOptimal) return status;
  }
  return LpStatus::kOptimal;
}

/// From a loaded dual-feasible basis to the optimum.
///
/// Symbols: x is where the basis' rows hold with equality, y their weights, `violation` how much x
/// breaks the worst row. Invariant: y >= 0 to kWeightSlack, so the objective at x bounds that of
/// every feasible point, and no pivot makes it worse; x is the optimum once it breaks no row.
/// Source: the dual simplex method (Lemke 1954), ratio test after Harris (1973). Ends: a basis can
/// return only while the objective stands still; after kStallLimit such pivots Bland's rule (1977)
/// lets none return, and there are finitely many; against rounding, after `pivot_limit`.
template <class Basis, class Rows>
SimplexEnd run_simplex(Basis& basis, const Rows& rows, int pivots, int pivot_limit) {
  double best = std::numeric_limits<double>::infinity();
  int stalled = 0;
  for (;; ++pivots) {
    if (!is_finite(basis.x)) return {LpStatus::kNumerical, pivots, 0};
    const double tolerance =
        kFeasibility * std::max(rows.scale(), basis.x.template lpNorm<Eigen::Infinity>());
    if (basis.objective() < best) {
      best = basis.objective() - 1e-3 * tolerance;
      stalled = 0;
    } else {
      ++stalled;
    }
    const bool bland = stalled > kStallLimit;
    const double level = basis.level();
    const Excess worst = bland ? rows.first_exceeded(basis.x, level + tolerance)
                               : rows.most_exceeded(basis.x, level, basis.ids);
    const double violation = worst.plane == Excess::kNone ? 0 : worst.value - level;
    if (violation <= tolerance) return {LpStatus::kOptimal, pivots, violation};
    if (std::find(basis.ids.begin(), basis.ids.end(), worst.plane) != basis.ids.end())
      return {LpStatus::kNumerical, pivots, violation};
    if (pivots >= pivot_limit) return {LpStatus::kPivotLimit, pivots, violation};
    const LpStatus status = pivot(basis, rows, worst.plane, bland);
    if (status != LpStatus::kOptimal) return {status, pivots + 1, violation};
  }
}

}  // namespace osteon
