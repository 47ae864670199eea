#include "osteon/collide/primitive.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "osteon/base/check.h"
#include "osteon/hull/hull.h"

namespace osteon {

Primitive make_rod(const Vec3& p0_T, const Vec3& p1_T, double radius_m) {
  demand(is_finite(p0_T) && is_finite(p1_T) && radius_m > 0 && radius_m < 1e3,
         "a rod needs finite ends and a radius above 0");
  Primitive out;
  out.rod = {p0_T, p1_T, radius_m};
  out.middle = 0.5 * (p0_T + p1_T);
  out.radius = 0.5 * (p1_T - p0_T).norm() + radius_m;
  return out;
}

Primitive make_box(const Pose& X_TB, const Vec3& half_m) {
  demand(is_finite(X_TB) && is_finite(half_m) && half_m.minCoeff() > 0,
         "a box needs a finite position and sides above 0");
  std::vector<Vec3> corners;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0})
      for (const double z : {-1.0, 1.0})
        corners.push_back(X_TB * half_m.cwiseProduct(Vec3(x, y, z)));
  HullOutcome hull = build_hull(corners);
  demand(hull.hull.has_value(), "a box is too thin");
  Primitive out;
  out.kind = Primitive::Kind::kBox;
  out.X_TB = X_TB;
  out.half = half_m;
  out.rod = {X_TB.p, X_TB.p, 0};
  out.body = make_convex_body(*hull.hull);
  out.middle = X_TB.p;
  out.radius = half_m.norm();
  return out;
}

double support(const Primitive& primitive, const Vec3& n_T) {
  if (primitive.kind == Primitive::Kind::kRod)
    return std::max(n_T.dot(primitive.rod.p0), n_T.dot(primitive.rod.p1)) + primitive.rod.radius;
  const Vec3 n_B = primitive.X_TB.q.conjugate() * n_T;
  return n_T.dot(primitive.X_TB.p) + n_B.cwiseAbs().dot(primitive.half);
}

}  // namespace osteon
