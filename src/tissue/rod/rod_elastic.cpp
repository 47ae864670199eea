#include "rod/rod_elastic.h"

namespace osteon::rods {
namespace {

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

Vec3 bending_n_m(const Rod& rod, const Vec3& turn, std::size_t inner, double span) {
  const Vec3 b(rod.section.bend_n_m2, rod.section.bend_n_m2, rod.section.twist_n_m2);
  return b.cwiseProduct(turn - rod.rest_turn[inner]) / span;
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

}  // namespace osteon::rods
