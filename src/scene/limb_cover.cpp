#include "osteon/scene/limb_cover.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {

// Below this the axis of a turn is lost in rounding; it moves nothing of a limb by a tenth of a mm.
constexpr double kNoTurn_rad = 1e-4;
constexpr double kFolded = 0.05;  // two bones in one direction: no plane parts them

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

std::vector<Vec3> vertices_W(const Bone& bone) {
  std::vector<Vec3> out;
  for (const Vec3& p : bone.mesh.vertices) out.push_back(bone.X_WB * p);
  return out;
}

Vec3 box_middle(const std::vector<Vec3>& points) {
  Vec3 lo = points.front(), hi = points.front();
  for (const Vec3& p : points) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  return (lo + hi) / 2;
}

Vec3 nearest_to(const std::vector<Vec3>& points, const Vec3& to) {
  return *std::min_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return (a - to).squaredNorm() < (b - to).squaredNorm();
  });
}

// Axis, angle, point and way of the screw that a motion is (Chasles). A point c of the axis stays
// on it: (I - R) c = t less its part along the axis, hence c = (t + cot(angle / 2) u x t) / 2.
void set_screw(const Pose& motion, CoverMotion& out) {
  Quat q = motion.q;
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  out.angle_rad = 2 * std::atan2(sine, q.w());
  if (out.angle_rad < kNoTurn_rad) {
    out.angle_rad = 0;
    out.along_m = motion.p.norm();
    if (out.along_m > 0) out.axis = motion.p / out.along_m;
    return;
  }
  out.axis = q.vec() / sine;
  out.along_m = out.axis.dot(motion.p);
  const Vec3 across = motion.p - out.along_m * out.axis;
  out.point = (across + q.w() / sine * out.axis.cross(across)) / 2;
}

}  // namespace

Vec3 CoverMotion::moved(const Vec3& p_W, double share) const {
  const Vec3 turned = Eigen::AngleAxisd(share * angle_rad, axis) * (p_W - point);
  return upper * Vec3(point + turned + share * along_m * axis);
}

// The plane halves the angle between the directions in which the bones leave the joint.
std::optional<LimbCover> LimbCover::over(const Case& the_case) {
  const BoneId upper = the_case.find("femur"), lower = the_case.find("tibia");
  if (!upper.valid() || !lower.valid()) return {};
  const std::vector<Vec3> above = vertices_W(the_case.bone(upper));
  const std::vector<Vec3> below = vertices_W(the_case.bone(lower));
  if (above.empty() || below.empty()) return {};
  const Vec3 above_W = box_middle(above), below_W = box_middle(below);
  LimbCover out;
  out.upper_ = upper.index;
  out.lower_ = lower.index;
  out.kneecap_ = the_case.find("patella");
  out.middle_W_ = (nearest_to(above, below_W) + nearest_to(below, above_W)) / 2;
  const Vec3 down = (below_W - out.middle_W_).normalized();
  const Vec3 up = (above_W - out.middle_W_).normalized();
  const Vec3 across = down - up;
  if (!(across.norm() > kFolded)) return {};
  out.towards_lower_W_ = across.normalized();
  if ((down + up).norm() > kFolded) out.forwards_W_ = -(down + up).normalized();
  for (const Landmark& place : the_case.landmarks) {
    if (!place.name.starts_with("portal_")) continue;
    if (place.bone == "femur") out.wholes_.push_back({place.p_W, 0});
    if (place.bone == "tibia") out.wholes_.push_back({place.p_W, 1});
  }
  return out;
}

double LimbCover::share(const Vec3& p_W) const {
  const Vec3 from_W = p_W - middle_W_;
  const double front = smooth_step(0, kFront_m, forwards_W_.dot(from_W));
  const double half_m = kHalfBehind_m + front * (kHalfInFront_m - kHalfBehind_m);
  double share = smooth_step(-half_m, half_m, towards_lower_W_.dot(from_W));
  for (const Whole& whole : wholes_) {
    const double far = smooth_step(kWholeTo_m, kWholeFrom_m, (p_W - whole.center_W).norm());
    share = whole.share + far * (share - whole.share);
  }
  return share;
}

CoverMotion LimbCover::motion(const BoneSnapshot& bones, std::span<const Pose> rest_X_WB) const {
  CoverMotion out;
  if (std::max(upper_, lower_) >= std::min<std::size_t>(bones.count, rest_X_WB.size())) return out;
  out.upper = bones.bones[upper_].X_WB * rest_X_WB[upper_].inverse();
  set_screw(out.upper.inverse() * (bones.bones[lower_].X_WB * rest_X_WB[lower_].inverse()), out);
  return out;
}

}  // namespace osteon
