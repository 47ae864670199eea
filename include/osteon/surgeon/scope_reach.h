#pragma once

#include <optional>

#include "osteon/procedure/scope_watch.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Where a scope looks: at a point, from a distance, turned about the line from its portal to it.
struct Gaze {
  Vec3 at_W = Vec3::Zero();
  double distance_m = 0.02;
  double turn_rad = 0;  ///< 0: the picture is upright
};

/// The pose of a scope whose shaft passes through the portal and which has the gaze's point in the
/// middle of its picture.
///
/// Portal P, window E and point T make a triangle with |PT| = D, |ET| = d and the angle pi - a at
/// E, where a is the angle of the optic: |PE| = sqrt(D^2 - d^2 sin^2 a) - d cos a. The triangle
/// stands upright at turn 0, E above the line; `turn_rad` turns it about that line. None: the
/// point is nearer to the portal than the distance, or straight over or under it.
std::optional<Pose> pose_for(const Gaze& gaze, const Vec3& portal_W, const ScopeOptics& optics);

/// Room about a scope's shaft from the tip to the portal, m; below 0: it meets a bone.
double shaft_room_m(const Case& the_case, const Pose& X_WT, const Vec3& portal_W, double radius_m);

}  // namespace osteon
