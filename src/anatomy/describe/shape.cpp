#include "describe/shape.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

double norm(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

Vec3 turn(const Mat3& R, const Vec3& v) {
  return {R(0, 0) * v.x() + R(0, 1) * v.y() + R(0, 2) * v.z(),
          R(1, 0) * v.x() + R(1, 1) * v.y() + R(1, 2) * v.z(),
          R(2, 0) * v.x() + R(2, 1) * v.y() + R(2, 2) * v.z()};
}

double dot(const Vec3& a, const Vec3& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }

/// Distance to the convex hull of two spheres (round cone), after I. Quilez, "Distance functions".
double round_cone(const Vec3& p, const Vec3& a, const Vec3& b, double r1, double r2) {
  const Vec3 ba = b - a;
  const double l2 = dot(ba, ba);
  const double rr = r1 - r2;
  const double a2 = l2 - rr * rr;
  const Vec3 pa = p - a;
  // One sphere holds the other: the hull is the larger sphere.
  if (a2 <= 0) return rr > 0 ? std::sqrt(dot(pa, pa)) - r1 : std::sqrt(dot(p - b, p - b)) - r2;
  const double il2 = 1.0 / l2;
  const double y = dot(pa, ba);
  const double z = y - l2;
  const Vec3 w = pa * l2 - ba * y;
  const double x2 = dot(w, w);
  const double y2 = y * y * l2;
  const double z2 = z * z * l2;
  const double sign = rr > 0 ? 1.0 : (rr < 0 ? -1.0 : 0.0);
  const double k = sign * rr * rr * x2;
  if ((z > 0 ? 1.0 : -1.0) * a2 * z2 > k) return std::sqrt(x2 + z2) * il2 - r2;
  if ((y > 0 ? 1.0 : -1.0) * a2 * y2 < k) return std::sqrt(x2 + y2) * il2 - r1;
  return (std::sqrt(x2 * a2 * il2) + y * rr) * il2 - r1;
}

/// Catmull-Rom between b (t = 0) and c (t = 1).
template <class T>
T spline(const T& a, const T& b, const T& c, const T& d, double t) {
  const double t2 = t * t, t3 = t2 * t;
  return 0.5 * ((2 * t2 - t3 - t) * a + (3 * t3 - 5 * t2 + 2) * b + (4 * t2 - 3 * t3 + t) * c +
                (t3 - t2) * d);
}

/// Value at span i and parameter t; beyond the ends the values go on straight.
template <class T>
T spline_at(const std::vector<T>& v, std::size_t i, double t) {
  const T before = i > 0 ? v[i - 1] : T(2 * v[i] - v[i + 1]);
  const T after = i + 2 < v.size() ? v[i + 2] : T(2 * v[i + 1] - v[i]);
  return spline<T>(before, v[i], v[i + 1], after, t);
}

struct SinCos {
  double sin, cos;
};

/// Taylor series of an angle of at most 45 degrees; its error is below 1e-16.
SinCos small_sin_cos(double radians) {
  const double x2 = radians * radians;
  double s = 0, c = 0;
  for (int n = 10; n >= 1; --n) {
    s = (1 + s) * (-x2 / ((2.0 * n) * (2.0 * n + 1)));
    c = (1 + c) * (-x2 / ((2.0 * n - 1) * (2.0 * n)));
  }
  return {radians * (1 + s), 1 + c};
}

SinCos sin_cos_deg(double degrees) {
  const double quarters = std::floor(degrees / 90 + 0.5);
  const SinCos r = small_sin_cos((degrees - 90 * quarters) * (3.14159265358979323846 / 180));
  const int quadrant = static_cast<int>(quarters - 4 * std::floor(quarters / 4));
  if (quadrant == 1) return {r.cos, -r.sin};
  if (quadrant == 2) return {-r.sin, -r.cos};
  if (quadrant == 3) return {-r.cos, r.sin};
  return r;
}

Aabb turned_box(const Vec3& center, const Vec3& half, const Mat3& R_local) {
  Aabb box;
  const Vec3 reach = R_local.transpose().cwiseAbs() * half;
  box.include(center - reach);
  box.include(center + reach);
  return box;
}

struct Bounder {
  Aabb operator()(const Ellipsoid& e) const { return turned_box(e.center, e.radii, e.R_local); }
  Aabb operator()(const RoundedBox& b) const { return turned_box(b.center, b.half, b.R_local); }
  Aabb operator()(const HalfSpace&) const { return {}; }
  Aabb operator()(const Crack&) const { return {}; }
  Aabb operator()(const Tube& t) const {
    Aabb box;
    for (std::size_t i = 0; i < t.points.size(); ++i) {
      box.include(t.points[i] - Vec3::Constant(t.radii[i]));
      box.include(t.points[i] + Vec3::Constant(t.radii[i]));
    }
    return box;
  }
};

}  // namespace

Tube tube_through(const std::vector<Vec3>& points, const std::vector<double>& radii) {
  const int steps = points.size() < 3 ? 1 : 6;
  Tube tube;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (int k = 0; k < steps; ++k) {
      tube.points.push_back(spline_at(points, i, static_cast<double>(k) / steps));
      tube.radii.push_back(spline_at(radii, i, static_cast<double>(k) / steps));
    }
  tube.points.push_back(points.back());
  tube.radii.push_back(radii.back());
  find_reach(tube);
  return tube;
}

void find_reach(Tube& tube) {
  tube.reach.clear();
  for (std::size_t i = 0; i + 1 < tube.points.size(); ++i) {
    const Vec3 along = tube.points[i + 1] - tube.points[i];
    tube.reach.push_back(std::max(tube.radii[i], std::sqrt(dot(along, along)) + tube.radii[i + 1]));
  }
}

double distance(const Ellipsoid& e, const Vec3& p) {
  const Vec3 q = turn(e.R_local, p - e.center);
  const double x = q.x() / e.radii.x(), y = q.y() / e.radii.y(), z = q.z() / e.radii.z();
  const double k0 = norm(x, y, z);
  const double k1 = norm(x / e.radii.x(), y / e.radii.y(), z / e.radii.z());
  if (k1 < 1e-12) return -e.radii.minCoeff();
  return k0 * (k0 - 1) / k1;
}

double distance(const Tube& t, const Vec3& p) { return distance(t, p, 0, t.reach.size()); }

double distance(const Tube& t, const Vec3& p, std::size_t first, std::size_t last) {
  double nearest =
      first > 0 ? 1e300 : std::sqrt(dot(p - t.points[0], p - t.points[0])) - t.radii[0];
  for (std::size_t i = first; i < last; ++i) {
    const double limit = nearest + t.reach[i];  // beyond it the cone cannot be nearer
    const Vec3 away = p - t.points[i];
    if (limit > 0 && dot(away, away) > limit * limit) continue;
    nearest =
        std::min(nearest, round_cone(p, t.points[i], t.points[i + 1], t.radii[i], t.radii[i + 1]));
  }
  return nearest;
}

double narrow_cones(const Tube& t, const Vec3& p, double more, std::uint32_t& first,
                    std::uint32_t& last) {
  double nearest = distance(t, p, first, last);
  const auto too_far = [&](std::uint32_t i) {
    const Vec3 away = p - t.points[i];
    const double limit = nearest + more + t.reach[i];
    if (limit > 0 && dot(away, away) > limit * limit) return true;
    return round_cone(p, t.points[i], t.points[i + 1], t.radii[i], t.radii[i + 1]) > nearest + more;
  };
  while (first + 1 < last && too_far(first)) ++first;
  while (first + 1 < last && too_far(last - 1)) --last;
  return nearest;
}

double distance(const RoundedBox& b, const Vec3& p) {
  const Vec3 q = turn(b.R_local, p - b.center);
  const double x = std::abs(q.x()) - b.half.x() + b.round;
  const double y = std::abs(q.y()) - b.half.y() + b.round;
  const double z = std::abs(q.z()) - b.half.z() + b.round;
  const double outside = norm(std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0));
  return outside + std::min(std::max(x, std::max(y, z)), 0.0) - b.round;
}

double distance(const HalfSpace& h, const Vec3& p) { return dot(h.normal, p - h.point); }

double distance(const Primitive& primitive, const Vec3& p) {
  return std::visit([&p](const auto& s) { return distance(s, p); }, primitive);
}

Aabb bounds(const Primitive& primitive) { return std::visit(Bounder{}, primitive); }

double stretch(const Primitive& primitive) {
  const auto* e = std::get_if<Ellipsoid>(&primitive);
  return e ? e->radii.maxCoeff() / e->radii.minCoeff() : 1.0;
}

double smooth_min(double a, double b, double k) {
  const double apart = std::abs(a - b);
  if (apart >= k) return std::min(a, b);
  const double h = (k - apart) / k;
  return std::min(a, b) - h * h * k * 0.25;
}

double smooth_max(double a, double b, double k) { return -smooth_min(-a, -b, k); }

double less(double d, const Part& cut, const Vec3& p) {
  return smooth_max(d, -distance(cut.primitive, p), cut.blend);
}

double distance(const Solid& solid, const Vec3& p) {
  double d = distance(solid.parts[0].primitive, p);
  for (std::size_t i = 1; i < solid.parts.size(); ++i) {
    const Part& part = solid.parts[i];
    const double other = distance(part.primitive, p);
    d = part.operation == Operation::kAdd ? smooth_min(d, other, part.blend)
                                          : smooth_max(d, -other, part.blend);
  }
  return d;
}

Aabb bounds(const Solid& solid) {
  Aabb box;
  double widest_blend = 0;
  for (const Part& part : solid.parts) {
    if (part.operation != Operation::kAdd) continue;
    const Aabb b = bounds(part.primitive);
    box.include(b.lo);
    box.include(b.hi);
    widest_blend = std::max(widest_blend, part.blend);
  }
  return box.grown(0.5 * widest_blend);
}

double stretch(const Solid& solid) {
  double most = 1;
  for (const Part& part : solid.parts) most = std::max(most, stretch(part.primitive));
  return most;
}

Mat3 rotation_xyz_deg(const Vec3& angles_deg) {
  const SinCos a = sin_cos_deg(angles_deg.x());
  const SinCos b = sin_cos_deg(angles_deg.y());
  const SinCos c = sin_cos_deg(angles_deg.z());
  Mat3 R;
  R << c.cos * b.cos, c.cos * b.sin * a.sin - c.sin * a.cos, c.cos * b.sin * a.cos + c.sin * a.sin,
      c.sin * b.cos, c.sin * b.sin * a.sin + c.cos * a.cos, c.sin * b.sin * a.cos - c.cos * a.sin,
      -b.sin, b.cos * a.sin, b.cos * a.cos;
  return R;
}

}  // namespace osteon
