#include "osteon/collide/lp_contact.h"
#include "pair_rows.h"
#include "simplex.h"

namespace osteon {
namespace {

std::array<std::uint32_t, 3> three(const LpBasis& basis) {
  return {basis.rows[0], basis.rows[1], basis.rows[2]};
}

bool warm(CornerBasis& corner, const PairRows& rows, const LpBasis* basis) {
  if (!basis || basis->count != 3) return false;
  const auto ids = three(*basis);
  if (std::any_of(ids.begin(), ids.end(), [&](auto id) { return id >= rows.count(); }))
    return false;
  return load_basis(corner, rows, ids) && dual_feasible(corner);
}

// Bodies this far apart do not touch, m.
constexpr double kTouchingGap = 1e-10;

// Where facets of both bodies meet at a needle's angle, a point may keep every plane to rounding
// and still be far from both bodies. Such an answer needs a witness: a direction that parts them.
bool parted(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB) {
  const LpDepth depth = lp_depth(a, b, X_AB);
  return depth.status == LpStatus::kOptimal && depth.gap > kTouchingGap;
}

SimplexEnd from(CornerBasis& corner, const PairRows& rows, int pivots) {
  corner.solve();
  return run_simplex(corner, rows, pivots, kPivotLimit);
}

}  // namespace

LpHit lp_test(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, LpBasis* basis) {
  LpHit hit;
  if (!is_finite(X_AB)) return hit;
  const PairRows rows(a, b, X_AB, basis ? &basis->near : nullptr);
  CornerBasis corner;
  SimplexEnd end;
  if (warm(corner, rows, basis)) end = from(corner, rows, 0);
  if (end.status != LpStatus::kOptimal && end.status != LpStatus::kUnbounded &&
      load_basis(corner, rows, a.corner))
    end = from(corner, rows, end.pivots);
  hit.status = end.status;
  const bool doubtful = end.residual > 1e-15 * rows.scale();
  hit.hit = end.status == LpStatus::kOptimal && !(doubtful && parted(a, b, X_AB));
  hit.p_A = a.center + corner.x;
  hit.pivots = end.pivots;
  if (basis && end.status == LpStatus::kOptimal && end.pivots == 0) rows.list_near(corner.x, 0);
  if (basis) {
    const bool known = end.status == LpStatus::kOptimal || end.status == LpStatus::kUnbounded;
    basis->rows = {corner.ids[0], corner.ids[1], corner.ids[2], 0};
    basis->count = known ? 3 : 0;
  }
  return hit;
}

}  // namespace osteon
