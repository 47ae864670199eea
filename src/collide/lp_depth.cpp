#include "osteon/collide/lp_contact.h"
#include "pair_rows.h"
#include "separation.h"
#include "simplex.h"

namespace osteon {
namespace {

// Below this share of A's planes in the weights their sum has no direction.
constexpr double kLeastBalance = 1e-9;

bool known_rows(const LpBasis& basis, const PairRows& rows) {
  return basis.count == 4 && std::all_of(basis.rows.begin(), basis.rows.end(),
                                         [&](auto id) { return id < rows.count(); });
}

// The middle of the smaller body is nearer to where they meet.
std::array<std::uint32_t, 4> own_basis(const ConvexBody& a, const ConvexBody& b) {
  std::array<std::uint32_t, 4> ids = b.radius < a.radius ? b.basis : a.basis;
  if (b.radius < a.radius)
    for (std::uint32_t& id : ids) id += a.plane_count;
  return ids;
}

// A search of a body with more planes than this costs more than a pivot.
constexpr std::uint32_t kManyPlanes = 256;

// The last basis where it still fits, else the smaller body's own, with as much of the last one as
// applies.
bool start(DepthBasis& depth, const PairRows& rows, const std::array<std::uint32_t, 4>& own,
           const LpBasis* last, int& pivots) {
  const bool known = last && known_rows(*last, rows);
  if (known && load_basis(depth, rows, last->rows) && dual_feasible(depth)) {
    depth.solve();
    return true;
  }
  if (!load_basis(depth, rows, own)) return false;
  depth.solve();
  if (known) return crash(depth, rows, last->rows, pivots) == LpStatus::kOptimal;
  if (rows.count() < kManyPlanes) return true;
  return approach(depth, rows, pivots) == LpStatus::kOptimal;
}

// Sum of A's weighted normals: from A to B.
Vec3 push_of_a(const DepthBasis& depth, const PairRows& rows) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k)
    if (rows.is_a(depth.ids[k])) sum += std::max(depth.y[k], 0.0) * depth.rows[k].n;
  return sum;
}

bool both_sides(const DepthBasis& depth, const PairRows& rows) {
  double a = 0, b = 0;
  for (std::size_t k = 0; k < 4; ++k)
    (rows.is_a(depth.ids[k]) ? a : b) += std::max(depth.y[k], 0.0);
  return std::min(a, b) > kLeastBalance;
}

void set_direction(LpDepth& out, const DepthBasis& depth, const PairRows& rows, const ConvexBody& a,
                   const ConvexBody& b, const Pose& X_AB, LpNear* near, bool list_anew) {
  const Vec3 push = push_of_a(depth, rows);
  const double length = push.norm();
  if (both_sides(depth, rows) && length > kLeastBalance) {
    out.nhat_AB_A = push / length;
    const GapAlong along = near ? gap_along(a, b, X_AB, out.nhat_AB_A, *near, list_anew)
                                : gap_along(a, b, X_AB, out.nhat_AB_A);
    out.gap = along.gap;
    out.top_A = along.top_A;
    return;
  }
  const Separation best = least_overlap_facet(a, b, X_AB);
  out.nhat_AB_A = best.nhat_AB_A;
  out.gap = best.gap;
  out.top_A = support(a, best.nhat_AB_A);
}

}  // namespace

LpDepth lp_depth(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, LpBasis* basis) {
  LpDepth out;
  if (!is_finite(X_AB)) return out;
  LpNear* const near = basis ? &basis->near : nullptr;
  const PairRows rows(a, b, X_AB, near);
  DepthBasis depth;
  SimplexEnd end;
  int pivots = 0;
  const auto own = own_basis(a, b);
  if (start(depth, rows, own, basis, pivots)) end = run_simplex(depth, rows, pivots, kPivotLimit);
  if (end.status != LpStatus::kOptimal && basis && load_basis(depth, rows, own)) {
    depth.solve();
    end = run_simplex(depth, rows, end.pivots, end.pivots + kPivotLimit);
  }
  out.status = end.status;
  out.pivots = end.pivots;
  out.residual = end.residual;
  out.t = depth.t;
  out.p_A = a.center + depth.x;
  // Where the last basis still was the best, the next query will likely look in the same places.
  const bool calm = basis && end.status == LpStatus::kOptimal && end.pivots == 0;
  if (end.status == LpStatus::kOptimal) set_direction(out, depth, rows, a, b, X_AB, near, calm);
  if (calm) rows.list_near(depth.x, depth.t);
  if (basis) {
    basis->rows = depth.ids;
    basis->count = end.status == LpStatus::kOptimal ? 4 : 0;
  }
  return out;
}

}  // namespace osteon
