#pragma once

#include <vector>

#include "osteon/tissue/rod.h"
#include "rod/rod_band.h"

namespace osteon::rods {

/// Where the nodes and frames of a rod are.
struct RodPose {
  std::vector<Vec3> x;
  std::vector<Quat> q;
};

/// Unknowns of node i begin at 6 i, those of segment i (a turn in its own frame) at 6 i + 3.
inline std::size_t node_at(std::size_t i) { return 6 * i; }
inline std::size_t frame_at(std::size_t i) { return 6 * i + 3; }
inline std::size_t unknowns(const Rod& rod) { return 6 * rod.segments() + 3; }

inline void add_three(std::vector<double>& to, std::size_t at, const Vec3& v) {
  for (std::size_t k = 0; k < 3; ++k) to[at + k] += v[static_cast<Eigen::Index>(k)];
}

inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// The turn from a to b, in their frames: 4 tan(angle / 4) times the axis, which is the rotation
/// vector to second order and smooth to a whole turn (modified Rodrigues parameters times four).
Vec3 turn_between(const Quat& a, const Quat& b);

/// A frame turned by a small way in its own axes.
Quat turned_by(const Quat& q, const Vec3& way_S);

/// Length of rod that each inner node's bending spring stands for: half of both neighbours, but
/// none of a segment that is held.
std::vector<double> spans(const Rod& rod, const std::vector<bool>& held_frame);

double elastic_energy_j(const Rod& rod, const std::vector<double>& spans, const RodPose& pose);

/// Adds the slope of the elastic energy, and its stiffness if wanted. The stiffness leaves out what
/// could make it negative: bending moments that turn, and push; pull that turns is kept, so that a
/// taut rod is as stiff across as it is.
void add_elastic(const Rod& rod, const std::vector<double>& spans, const RodPose& pose,
                 std::vector<double>& slope, RodBand* stiffness);

}  // namespace osteon::rods
