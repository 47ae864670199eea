#include "osteon/collide/primitive_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "distance_search.h"
#include "field_box.h"
#include "osteon/collide/field_contact.h"
#include "osteon/collide/segments.h"

namespace osteon {
namespace {

Capsule moved(const Pose& X_AB, const Capsule& rod) {
  return {X_AB * rod.p0, X_AB * rod.p1, rod.radius};
}

PrimitiveContact from_capsule(const CapsuleContact& contact, const Capsule& rod_A) {
  PrimitiveContact out{contact.status, contact.gap, contact.nhat_AB_A, contact.p_A, 0};
  const double lowest = std::min(out.nhat_AB_A.dot(rod_A.p0), out.nhat_AB_A.dot(rod_A.p1));
  out.top_A = lowest - rod_A.radius - out.gap;
  return out;
}

PrimitiveContact from_depth(const LpDepth& depth) {
  return {depth.status, depth.gap, depth.nhat_AB_A, depth.p_A, depth.top_A};
}

Vec3 any_across(const Vec3& along) {
  const Vec3 other = std::abs(along.x()) < std::abs(along.y()) ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 across = along.cross(other);
  const double size = across.norm();
  return size > 0 ? Vec3(across / size) : Vec3(Vec3::UnitX());
}

// Of axes that cross, the shortest way apart is across both.
Vec3 across_both(const Capsule& a, const Capsule& b) {
  const Vec3 u = a.p1 - a.p0;
  const Vec3 v = b.p1 - b.p0;
  const Vec3 across = u.cross(v);
  const double size = across.norm();
  if (size > 1e-9 * u.norm() * v.norm() && size > 0) return across / size;
  return any_across(u.squaredNorm() > v.squaredNorm() ? u : v);
}

PrimitiveContact rod_rod(const Capsule& a, const Capsule& b_A) {
  PrimitiveContact out;
  const AxisPoints near = nearest_on_axes(a, b_A);
  const Vec3 apart = near.b - near.a;
  const double distance = apart.norm();
  if (!std::isfinite(distance)) return out;
  constexpr double kCrossing = 1e-12;
  out.status = LpStatus::kOptimal;
  out.nhat_AB_A = distance > kCrossing ? Vec3(apart / distance) : across_both(a, b_A);
  out.gap = distance - a.radius - b_A.radius;
  out.p_A = near.a + a.radius * out.nhat_AB_A;
  out.top_A = out.nhat_AB_A.dot(near.a) + a.radius;
  return out;
}

// The two change places.
PrimitiveContact seen_from_other(const PrimitiveContact& contact, const Pose& X_AB) {
  PrimitiveContact out = contact;
  out.nhat_AB_A = -X_AB.rotate(contact.nhat_AB_A);
  out.p_A = X_AB * (contact.p_A + contact.gap * contact.nhat_AB_A);
  return out;
}

// Largest gap along the fifteen axes of two boxes (Gottschalk, Lin and Manocha 1996): where they
// overlap, its negative is the shortest way that parts them.
PrimitiveContact box_overlap(const Primitive& a, const Primitive& b, const Pose& X_AB) {
  const Mat3 A = a.X_TB.q.toRotationMatrix();
  const Mat3 B = (X_AB.q * b.X_TB.q).toRotationMatrix();
  const Vec3 apart = X_AB * b.X_TB.p - a.X_TB.p;
  PrimitiveContact out;
  out.gap = -1e300;
  const auto look = [&](const Vec3& axis) {
    const double size = axis.norm();
    if (size < 1e-9) return;
    Vec3 n = axis / size;
    if (n.dot(apart) < 0) n = -n;
    const double reach =
        (A.transpose() * n).cwiseAbs().dot(a.half) + (B.transpose() * n).cwiseAbs().dot(b.half);
    const double gap = n.dot(apart) - reach;
    if (gap > out.gap + 1e-12) {
      out.gap = gap;
      out.nhat_AB_A = n;
    }
  };
  for (int i = 0; i < 3; ++i) {
    look(A.col(i));
    look(B.col(i));
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) look(A.col(i).cross(B.col(j)));
  out.status =
      std::isfinite(out.gap) && out.gap > -1e299 ? LpStatus::kOptimal : LpStatus::kNumerical;
  out.top_A = support(a, out.nhat_AB_A);
  out.p_A = a.X_TB.p + (out.top_A - out.nhat_AB_A.dot(a.X_TB.p)) * out.nhat_AB_A;
  return out;
}

Vec3 corner_along(const Primitive& box, const Vec3& n_T) {
  const Vec3 n_B = box.X_TB.q.conjugate() * n_T;
  const auto side = [&](int i) { return n_B[i] < 0 ? -box.half[i] : box.half[i]; };
  return box.X_TB * Vec3(side(0), side(1), side(2));
}

PrimitiveContact box_box(const Primitive& a, const Primitive& b, const Pose& X_AB) {
  DistanceSearch search;
  const auto farthest = [&](const Vec3& v) {
    const Vec3 p_a = corner_along(a, -v);
    const Vec3 p_b = X_AB * corner_along(b, X_AB.q.conjugate() * v);
    return DifferencePoint{p_a - p_b, p_a, p_b};
  };
  const double touching = 1e-12 * (a.radius + b.radius);
  const bool apart = search_distance(a.X_TB.p - X_AB * b.X_TB.p, touching, farthest, search);
  if (!apart || !search.ended) return box_overlap(a, b, X_AB);
  PrimitiveContact out;
  out.status = LpStatus::kOptimal;
  out.gap = search.distance;
  out.nhat_AB_A = -search.v / search.distance;
  out.p_A = search.simplex.on_body();
  out.top_A = support(a, out.nhat_AB_A);
  return out;
}

bool is_rod(const Primitive& primitive) { return primitive.kind == Primitive::Kind::kRod; }

}  // namespace

PrimitiveContact primitive_contact(const ConvexBody& a, const Primitive& b, const Pose& X_AB,
                                   LpBasis* basis) {
  if (is_rod(b)) {
    const Capsule rod_A = moved(X_AB, b.rod);
    return from_capsule(capsule_contact(a, rod_A, basis), rod_A);
  }
  const LpDepth warm = lp_depth(a, b.body, X_AB, basis);
  if (warm.status == LpStatus::kOptimal || !basis) return from_depth(warm);
  *basis = {};
  return from_depth(lp_depth(a, b.body, X_AB, basis));
}

PrimitiveContact primitive_contact(const FieldView& a, const Primitive& b, const Pose& X_AB,
                                   double far_m, LowPlaces* places) {
  if (is_rod(b)) {
    const Capsule rod_A = moved(X_AB, b.rod);
    return from_capsule(field_contact(a, rod_A, far_m), rod_A);
  }
  PrimitiveContact out;
  if (!is_finite(X_AB)) return out;
  const BoxLowest lowest = lowest_of_box(a, X_AB * b.X_TB, b.half, far_m, places);
  const double slope = lowest.field.gradient.norm();
  if (!(slope > 1e-6) || !std::isfinite(slope)) return out;
  out.status = LpStatus::kOptimal;
  out.gap = lowest.field.distance;
  out.nhat_AB_A = lowest.field.gradient / slope;
  out.p_A = lowest.p - lowest.field.distance * out.nhat_AB_A;
  out.top_A = out.nhat_AB_A.dot(out.p_A);
  return out;
}

PrimitiveContact primitive_contact(const Primitive& a, const Primitive& b, const Pose& X_AB) {
  if (!is_finite(X_AB)) return {};
  if (is_rod(a) && is_rod(b)) return rod_rod(a.rod, moved(X_AB, b.rod));
  if (!is_rod(a) && !is_rod(b)) return box_box(a, b, X_AB);
  if (!is_rod(a)) return primitive_contact(a.body, b, X_AB);
  const Pose X_BA = X_AB.inverse();
  PrimitiveContact out = seen_from_other(primitive_contact(b.body, a, X_BA), X_AB);
  out.top_A = support(a, out.nhat_AB_A);
  return out;
}

}  // namespace osteon
