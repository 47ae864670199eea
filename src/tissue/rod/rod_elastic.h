#pragma once

#include <vector>

#include "osteon/tissue/rod.h"

namespace osteon::rods {

/// Where the nodes and frames of a rod are.
struct RodPose {
  std::vector<Vec3> x;
  std::vector<Quat> q;
};

/// The turn from a to b, in their frames: 4 tan(angle / 4) times the axis, which is the rotation
/// vector to second order and smooth to a whole turn (modified Rodrigues parameters times four).
Vec3 turn_between(const Quat& a, const Quat& b);

/// A frame turned by a small way in its own axes.
Quat turned_by(const Quat& q, const Vec3& way_S);

/// Length of rod that each inner node's bending spring stands for: half of both neighbours, but
/// none of a segment that is held.
std::vector<double> spans(const Rod& rod, const std::vector<bool>& held_frame);

double elastic_energy_j(const Rod& rod, const std::vector<double>& spans, const RodPose& pose);

}  // namespace osteon::rods
