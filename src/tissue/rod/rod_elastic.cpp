#include "rod/rod_elastic.h"

#include <algorithm>

namespace osteon::rods {
namespace {

// Adds a block of rows at r and columns at c <= r; of one on the diagonal the lower half.
void add_rows(RodBand& to, std::size_t r, std::size_t c, const Mat3& m) {
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = r == c ? j : 0; i < 3; ++i)
      to.at(r + i, c + j) += m(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

struct StretchedSegment {
  Mat3 r;       // frame to World
  Vec3 h;       // the segment's vector over its length at rest, in its frame: (0, 0, 1) at rest
  Vec3 pull_n;  // of the frame: shear, shear, stretch
};

StretchedSegment stretched(const Rod& rod, const RodPose& pose, std::size_t i) {
  StretchedSegment s;
  s.r = pose.q[i].toRotationMatrix();
  s.h = s.r.transpose() * ((pose.x[i + 1] - pose.x[i]) / rod.length_m[i]);
  const RodSection& k = rod.section;
  s.pull_n = {k.shear_n * s.h.x(), k.shear_n * s.h.y(), k.stretch_n * (s.h.z() - 1)};
  return s;
}

// Energy l/2 G.C G with G = R^T g - e3, C = (shear, shear, stretch), g = (x1 - x0) / l.
//   slope: x1: R C G; turn: l (C G) x h.
//   stiffness: with d = R^T (dx1 - dx0): dG = d / l + h x w, so C / l, C [h], l [h]^T C [h]; a pull
//   T adds -T [e3] between d and w and l T (e3 e3^T - 1) to w, which together are T / l across the
//   rod when frame and segment turn as one.
void add_stretch(const Rod& rod, const RodPose& pose, std::size_t i, std::vector<double>& slope,
                 RodBand* to) {
  const StretchedSegment s = stretched(rod, pose, i);
  const RodSection& k = rod.section;
  const double l = rod.length_m[i];
  const Vec3 push = s.r * s.pull_n;
  add_three(slope, node_at(i), -push);
  add_three(slope, node_at(i + 1), push);
  add_three(slope, frame_at(i), l * s.pull_n.cross(s.h));
  if (!to) return;
  const Vec3 d3 = s.r.col(2);
  Mat3 xx = ((k.stretch_n - k.shear_n) / l * d3) * d3.transpose();
  xx.diagonal().array() += k.shear_n / l;
  const Vec3 c(k.shear_n, k.shear_n, k.stretch_n);
  const Mat3 hx = cross_matrix(s.h);
  Mat3 dw = c.asDiagonal() * hx;
  Mat3 ww = l * (hx.transpose() * dw);
  const double pull = std::min(std::max(s.pull_n.z(), 0.0), 0.5 * k.shear_n);
  dw(0, 1) += pull;
  dw(1, 0) -= pull;
  ww(0, 0) -= l * pull;
  ww(1, 1) -= l * pull;
  const Mat3 xw = s.r * dw;
  add_rows(*to, node_at(i), node_at(i), xx);
  add_rows(*to, node_at(i + 1), node_at(i), -xx);
  add_rows(*to, node_at(i + 1), node_at(i + 1), xx);
  add_rows(*to, frame_at(i), node_at(i), -xw.transpose());
  add_rows(*to, node_at(i + 1), frame_at(i), xw);
  add_rows(*to, frame_at(i), frame_at(i), ww);
}

Vec3 bending_n_m(const Rod& rod, const Vec3& turn, std::size_t inner, double span) {
  const Vec3 b(rod.section.bend_n_m2, rod.section.bend_n_m2, rod.section.twist_n_m2);
  return b.cwiseProduct(turn - rod.rest_turn[inner]) / span;
}

// d turn = J w1 - J^T w0 with J = (1 - s^2) + 2 [s] + 2 s s^T, s = turn / 4 (Schaub, Junkins 1996).
Mat3 slope_of_turn(const Vec3& turn) {
  const Vec3 s = 0.25 * turn;
  Mat3 j = 2 * cross_matrix(s) + (2 * s) * s.transpose();
  j.diagonal().array() += 1 - s.squaredNorm();
  return j;
}

void add_bending(const Rod& rod, double span, const RodPose& pose, std::size_t inner,
                 std::vector<double>& slope, RodBand* to) {
  const std::size_t a = inner, b = inner + 1;  // segments
  const Vec3 turn = turn_between(pose.q[a], pose.q[b]);
  const Vec3 moment = bending_n_m(rod, turn, inner, span);
  const Mat3 j = slope_of_turn(turn);
  add_three(slope, frame_at(b), j.transpose() * moment);
  add_three(slope, frame_at(a), -(j * moment));
  if (!to) return;
  const Vec3 k = Vec3(rod.section.bend_n_m2, rod.section.bend_n_m2, rod.section.twist_n_m2) / span;
  const Mat3 kj = k.asDiagonal() * j;
  const Mat3 kjt = k.asDiagonal() * j.transpose();
  add_rows(*to, frame_at(b), frame_at(b), j.transpose() * kj);
  add_rows(*to, frame_at(a), frame_at(a), j * kjt);
  add_rows(*to, frame_at(b), frame_at(a), -(j.transpose() * kjt));
}

}  // namespace

Vec3 turn_between(const Quat& a, const Quat& b) {
  Quat r = a.conjugate() * b;
  if (r.w() < 0) r.coeffs() = -r.coeffs();
  return (4 / (1 + r.w())) * r.vec();
}

Quat turned_by(const Quat& q, const Vec3& way_S) {
  Quat out = q * Quat(1, 0.5 * way_S.x(), 0.5 * way_S.y(), 0.5 * way_S.z());
  out.normalize();
  return out;
}

std::vector<double> spans(const Rod& rod, const std::vector<bool>& held_frame) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < rod.segments(); ++i) {
    const double a = held_frame[i] ? 0 : rod.length_m[i];
    const double b = held_frame[i + 1] ? 0 : rod.length_m[i + 1];
    out.push_back(0.5 * (a + b > 0 ? a + b : rod.length_m[i] + rod.length_m[i + 1]));
  }
  return out;
}

double elastic_energy_j(const Rod& rod, const std::vector<double>& spans, const RodPose& pose) {
  double sum = 0;
  for (std::size_t i = 0; i < rod.segments(); ++i) {
    const StretchedSegment s = stretched(rod, pose, i);
    sum += 0.5 * rod.length_m[i] * s.pull_n.dot(s.h - Vec3::UnitZ());
  }
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Vec3 turn = turn_between(pose.q[i], pose.q[i + 1]);
    sum += 0.5 * bending_n_m(rod, turn, i, spans[i]).dot(turn - rod.rest_turn[i]);
  }
  return sum;
}

void add_elastic(const Rod& rod, const std::vector<double>& spans, const RodPose& pose,
                 std::vector<double>& slope, RodBand* stiffness) {
  for (std::size_t i = 0; i < rod.segments(); ++i) add_stretch(rod, pose, i, slope, stiffness);
  for (std::size_t i = 0; i < spans.size(); ++i)
    add_bending(rod, spans[i], pose, i, slope, stiffness);
}

}  // namespace osteon::rods
