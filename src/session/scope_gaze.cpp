#include "scope_gaze.h"

#include <algorithm>
#include <limits>

namespace osteon {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// Whether the line from `eye` along the unit vector passes the ball before `far_m`.
bool may_meet(const Vec3& eye, const Vec3& along, double far_m, const Vec3& p, double radius) {
  const Vec3 to = p - eye;
  const double at = std::clamp(to.dot(along), 0.0, far_m);
  return (to - at * along).squaredNorm() <= radius * radius;
}

// Where the line enters the hull: it is clipped by the planes (Cyrus and Beck, 1978), and what is
// left lies inside. Never, where it passes by or begins inside.
double enters(const Hull& hull, const Vec3& eye, const Vec3& along, double far_m) {
  double from = 0, to = far_m;
  for (const Plane& plane : hull.planes) {
    const double height = plane.signed_distance(eye), fall = -plane.n.dot(along);
    if (fall > 0)
      from = std::max(from, height / fall);
    else if (fall < 0)
      to = std::min(to, height / fall);
    else if (height > 0)
      return kNever;
    if (from > to) return kNever;
  }
  return from > 0 ? from : kNever;
}

}  // namespace

ScopeGaze::ScopeGaze(const Case& the_case) : case_(&the_case) {
  for (const Bone& bone : the_case.bones) {
    std::vector<Ball>& balls = pieces_.emplace_back();
    Aabb box;
    for (const ConvexBody& body : bone.bodies) {
      balls.push_back({body.center, body.radius});
      box.include(body.center - Vec3::Constant(body.radius));
      box.include(body.center + Vec3::Constant(body.radius));
    }
    bones_.push_back(box.empty() ? Ball{} : Ball{box.center(), 0.5 * box.extent().norm()});
  }
}

double ScopeGaze::nearest(std::size_t bone, const Vec3& eye_B, const Vec3& along_B,
                          double far_m) const {
  double least = kNever;
  const Ball& whole = bones_[bone];
  if (!may_meet(eye_B, along_B, far_m, whole.p_B, whole.radius_m)) return least;
  const std::vector<Hull>& pieces = case_->bones[bone].pieces;
  for (std::size_t k = 0; k < std::min(pieces.size(), pieces_[bone].size()); ++k) {
    const Ball& ball = pieces_[bone][k];
    if (!may_meet(eye_B, along_B, far_m, ball.p_B, ball.radius_m)) continue;
    least = std::min(least, enters(pieces[k], eye_B, along_B, far_m));
  }
  return least;
}

ScopeGaze::Seen ScopeGaze::middle_of(const ScopeView& view, const BoneSnapshot& bones) const {
  Seen seen;
  double least = kFarthest_m;
  const std::size_t count = std::min<std::size_t>(bones.count, case_->bones.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Pose X_BW = bones.bones[i].X_WB.inverse();
    const double at = nearest(i, X_BW * view.eye_W, X_BW.rotate(view.along_W), least);
    if (!(at < least)) continue;
    least = at;
    seen = {static_cast<std::uint32_t>(i), at, view.eye_W + at * view.along_W};
  }
  return seen;
}

}  // namespace osteon
