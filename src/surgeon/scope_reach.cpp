#include "osteon/surgeon/scope_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/surgeon/approach.h"

namespace osteon {

std::optional<Pose> pose_for(const Gaze& gaze, const Vec3& portal_W, const ScopeOptics& optics) {
  const Vec3 to = gaze.at_W - portal_W;
  const double far = to.norm(), d = gaze.distance_m;
  const double sine = std::sin(optics.angle_rad), cosine = std::cos(optics.angle_rad);
  if (!(far > d) || !(d > 0) || !is_finite(to)) return std::nullopt;
  const Vec3 u = to / far;
  Vec3 side = u.cross(Vec3::UnitZ());
  if (side.norm() < 1e-3) return std::nullopt;
  side.normalize();
  const Vec3 up = side.cross(u);
  const double reach = std::sqrt(far * far - d * d * sine * sine) - d * cosine;
  // The shaft runs under the line by the angle at the portal, so that the view leans up to it.
  const double lower = std::asin(std::clamp(d * sine / far, -1.0, 1.0));
  const Vec3 shaft = std::cos(lower) * u - std::sin(lower) * up;
  const Vec3 lean = std::sin(lower) * u + std::cos(lower) * up;
  Mat3 R;
  R << lean.cross(-shaft), lean, -shaft;
  const Eigen::AngleAxisd turned(gaze.turn_rad, u);
  return Pose{portal_W + turned * Vec3(reach * shaft),
              Quat(Mat3(turned.toRotationMatrix() * R)).normalized()};
}

double shaft_room_m(const Case& the_case, const Pose& X_WT, const Vec3& portal_W, double radius_m) {
  constexpr double kStride_m = 0.002;
  const double length = (portal_W - X_WT.p).norm();
  const Vec3 back = X_WT.rotate(Vec3::UnitZ());
  double room = std::numeric_limits<double>::infinity();
  for (double along = radius_m; along < length; along += kStride_m)
    for (const Bone& bone : the_case.bones)
      room = std::min(room, gap_to(bone, X_WT.p + along * back) - radius_m);
  return room;
}

}  // namespace osteon
