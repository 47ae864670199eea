#include "osteon/base/pose_track.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace osteon {
namespace {

/// Weights of four values about a span at its share t.
struct SplineWeights {
  double before, from, to, after;
};

SplineWeights spline_weights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {0.5 * (2 * t2 - t3 - t), 0.5 * (3 * t3 - 5 * t2 + 2), 0.5 * (4 * t2 - 3 * t3 + t),
          0.5 * (t3 - t2)};
}

/// q and -q are one turn: the one that is nearer to `other`.
Eigen::Vector4d towards(const Quat& q, const Eigen::Vector4d& other) {
  const Eigen::Vector4d c = q.coeffs();
  return c.dot(other) < 0 ? Eigen::Vector4d(-c) : c;
}

}  // namespace

// Symbols: i is the span that holds x, t the share of it, w the weights of the four poses about it.
// Invariant: the weights add up to 1, and at t = 0 and 1 are those of one pose alone, so the curve
// goes through all; one value and one slope stand on both sides of a pose. Source: Catmull and Rom
// 1974.
Pose pose_at(const PoseTrack& track, double x) {
  const std::vector<Pose>& at = track.poses;
  const double most = static_cast<double>(at.size()) - 1;
  const double place = std::clamp((x - track.first) / track.step, 0.0, most);
  const auto i = static_cast<std::size_t>(std::floor(place));
  const double t = place - std::floor(place);
  if (t == 0) return at[i];
  const SplineWeights w = spline_weights(t);
  const Eigen::Vector4d from = at[i].q.coeffs(), to = towards(at[i + 1].q, from);
  // Beyond the ends the track goes on as it came.
  const bool starts = i == 0, ends = i + 2 >= at.size();
  const Vec3 p_before = starts ? Vec3(2 * at[i].p - at[i + 1].p) : at[i - 1].p;
  const Vec3 p_after = ends ? Vec3(2 * at[i + 1].p - at[i].p) : at[i + 2].p;
  const Eigen::Vector4d q_before =
      starts ? Eigen::Vector4d(2 * from - to) : towards(at[i - 1].q, from);
  const Eigen::Vector4d q_after = ends ? Eigen::Vector4d(2 * to - from) : towards(at[i + 2].q, to);
  Pose X;
  X.p = w.before * p_before + w.from * at[i].p + w.to * at[i + 1].p + w.after * p_after;
  const Eigen::Vector4d q = w.before * q_before + w.from * from + w.to * to + w.after * q_after;
  X.q.coeffs() = q / q.norm();
  return X;
}

}  // namespace osteon
