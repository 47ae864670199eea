#pragma once

#include <array>
#include <cstdint>

#include "osteon/base/types.h"
#include "osteon/collide/convex_body.h"
#include "osteon/collide/near_list.h"

namespace osteon {

enum class LpStatus : std::uint8_t {
  kOptimal,     ///< the programme has an optimum
  kUnbounded,   ///< the dual is unbounded: the primal has no feasible point
  kPivotLimit,  ///< stopped after too many pivots; the result is not to be used
  kNumerical    ///< lost precision; the result is not to be used
};

/// Where a query of a pair looks first.
struct LpNear {
  NearList planes_a, planes_b, vertices_a, vertices_b;
};

/// Basis that a query leaves for the next one on the same pair. Rows below a.plane_count are planes
/// of A, the others planes of B. Default: cold.
struct LpBasis {
  std::array<std::uint32_t, 4> rows{};
  std::uint8_t count = 0;  ///< 0: cold
  LpNear near = {};
};

struct LpHit {
  LpStatus status = LpStatus::kNumerical;
  bool hit = false;
  Vec3 p_A = Vec3::Zero();  ///< a point of both bodies when hit, in A
  int pivots = 0;
};

/// Collision test of the wrist simulator's paper (section 5.2, equations 2-7): maximise x + y + z
/// over the planes of both bodies by the simplex method on the dual (minimise b.y, A^T y = c, y >=
/// 0). A bounded dual means collision. X_AB: pose of B in A. Touching counts as a hit.
LpHit lp_test(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB, LpBasis* basis = nullptr);

struct LpDepth {
  LpStatus status = LpStatus::kNumerical;
  /// Optimum of: minimise t subject to n_i.x - t <= d_i over the planes of both bodies, m. t < 0:
  /// the bodies overlap and -t is the radius of the largest ball inside both. t > 0: separated by
  /// at least 2 t.
  double t = 0;
  /// Signed gap along `nhat_AB_A`, m: > 0 apart (at most the distance), < 0 overlapping (moving B
  /// by -gap along nhat parts the bodies). Exact for that direction: from the support of both
  /// bodies.
  double gap = 0;
  double top_A = 0;                ///< largest nhat_AB_A.x over A, m
  Vec3 nhat_AB_A = Vec3::UnitZ();  ///< unit, from A to B, in A; from the dual weights of A's planes
  Vec3 p_A = Vec3::Zero();         ///< optimal x, in A
  int pivots = 0;
  double residual = 0;  ///< largest violation n_i.x - t - d_i left, m
};

/// Depth form of the contact programme, warm-started from `basis` when it fits. Allocates nothing.
LpDepth lp_depth(const ConvexBody& a, const ConvexBody& b, const Pose& X_AB,
                 LpBasis* basis = nullptr);

}  // namespace osteon
