#include "mass_properties.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

constexpr double kBallRadius = 0.005;

// Volume, and first and second moment of volume about a reference point.
struct Moments {
  double volume = 0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};

// Adds the tetrahedron of the reference point and a triangle. Its second moment is
// V/20 (s s^T + a a^T + b b^T + c c^T) with s = a + b + c (Tonon 2004).
void add_tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, Moments& m) {
  const double volume = a.dot(b.cross(c)) / 6;
  const Vec3 s = a + b + c;
  m.volume += volume;
  m.first += volume / 4 * s;
  m.second +=
      volume / 20 * (s * s.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
}

Moments moments_about(std::span<const Hull> pieces, const Vec3& p_B) {
  Moments m;
  for (const Hull& piece : pieces)
    for (const Triangle& t : piece.triangles)
      add_tetrahedron(piece.vertices[t[0]] - p_B, piece.vertices[t[1]] - p_B,
                      piece.vertices[t[2]] - p_B, m);
  return m;
}

Vec3 middle_of(std::span<const Hull> pieces) {
  Aabb box;
  for (const Hull& piece : pieces)
    for (const Vec3& v : piece.vertices) box.include(v);
  return box.empty() ? Vec3::Zero() : box.center();
}

// One rotation that makes a(p, q) zero (Golub and Van Loan, Matrix Computations, 8.5).
void rotate_away(int p, int q, Mat3& a, Mat3& axes) {
  if (a(p, q) == 0) return;
  const double tau = (a(q, q) - a(p, p)) / (2 * a(p, q));
  const double t = (tau >= 0 ? 1 : -1) / (std::abs(tau) + std::sqrt(1 + tau * tau));
  const double c = 1 / std::sqrt(1 + t * t);
  const double s = t * c;
  Mat3 turn = Mat3::Identity();
  turn(p, p) = turn(q, q) = c;
  turn(p, q) = s;
  turn(q, p) = -s;
  a = (turn.transpose() * a * turn).eval();
  axes = (axes * turn).eval();
  a(p, q) = a(q, p) = 0;
}

}  // namespace

Mat3 principal_axes(const Mat3& symmetric, Vec3& values) {
  constexpr int kSweeps = 12;  // convergence is quadratic: five are enough
  Mat3 a = symmetric;
  Mat3 axes = Mat3::Identity();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    rotate_away(0, 1, a, axes);
    rotate_away(0, 2, a, axes);
    rotate_away(1, 2, a, axes);
  }
  values = a.diagonal();
  return axes;
}

MassProperties mass_properties(std::span<const Hull> pieces, double mass_kg) {
  MassProperties result;
  result.mass_kg = mass_kg;
  const Vec3 p_B = middle_of(pieces);
  const Moments m = moments_about(pieces, p_B);
  if (!(m.volume > 0)) {
    result.X_BI.p = p_B;
    result.moments = Vec3::Constant(0.4 * mass_kg * kBallRadius * kBallRadius);
    return result;
  }
  const double density = mass_kg / m.volume;
  const Vec3 com = m.first / m.volume;
  const Mat3 second = density * (m.second - m.volume * com * com.transpose());
  const Mat3 inertia = second.trace() * Mat3::Identity() - second;
  const Mat3 axes = principal_axes(inertia, result.moments);
  result.X_BI = {p_B + com, Quat(axes).normalized()};
  return result;
}

// S = sum of m r r^T about the origin; about the centre c it is S - M c c^T, and the inertia there
// is tr(S) 1 - S.
MassProperties less(const MassProperties& whole, const BoneLoss& loss) {
  constexpr double kLeastMass = 0.05, kLeastMoment = 0.01;
  if (loss.mass_kg == 0) return whole;
  MassProperties left = whole;
  left.mass_kg = std::max(kLeastMass * whole.mass_kg, whole.mass_kg - loss.mass_kg);
  left.moments = left.mass_kg / whole.mass_kg * whole.moments;
  if (left.mass_kg == kLeastMass * whole.mass_kg) return left;
  const Mat3 axes = whole.X_BI.q.toRotationMatrix();
  const Vec3 c = whole.X_BI.p;
  const Vec3 about = Vec3::Constant(0.5 * whole.moments.sum()) - whole.moments;
  const Mat3 second = axes * about.asDiagonal() * axes.transpose() +
                      whole.mass_kg * c * c.transpose() - loss.second_B;
  const Vec3 com = (whole.mass_kg * c - loss.first_B) / left.mass_kg;
  const Mat3 central = second - left.mass_kg * com * com.transpose();
  Vec3 moments;
  const Mat3 turned = principal_axes(central.trace() * Mat3::Identity() - central, moments);
  left.moments = moments.cwiseMax(kLeastMoment * whole.moments.minCoeff());
  left.X_BI = {com, Quat(turned).normalized()};
  return left;
}

}  // namespace osteon
