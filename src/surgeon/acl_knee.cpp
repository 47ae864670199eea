#include "acl_knee.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "osteon/collide/segments.h"
#include "osteon/procedure/judge.h"

namespace osteon {

AclKnee::AclKnee(const Case& the_case, const Bone& femur, const Bone& tibia)
    : case_(&the_case),
      femur_(femur.mesh),
      tibia_(tibia.mesh),
      X_WF_(femur.X_WB),
      X_WT_(tibia.X_WB),
      left_(the_case.side == "left") {
  old_socket_ = old_between("old_socket_mouth", "old_socket_end");
  old_tunnel_ = old_between("old_tunnel_mouth", "old_tunnel_end");
}

std::optional<Capsule> AclKnee::old_between(std::string_view from, std::string_view to) const {
  constexpr double kRadius_m = 0.0037;
  if (!has_mark(from) || !has_mark(to)) return std::nullopt;
  return Capsule{mark(from), mark(to), kRadius_m};
}

double AclKnee::to_old_m(bool of_femur, const Vec3& from_W, const Vec3& to_W,
                         double radius_m) const {
  const auto& old = of_femur ? old_socket_ : old_tunnel_;
  if (!old) return std::numeric_limits<double>::infinity();
  const AxisPoints nearest = nearest_on_axes({from_W, to_W, radius_m}, *old);
  return (nearest.a - nearest.b).norm() - radius_m - old->radius;
}

Result<AclKnee> AclKnee::make(const Case& the_case) {
  const std::string where = "case '" + the_case.name + "'";
  const BoneId femur = the_case.find("femur"), tibia = the_case.find("tibia");
  if (!femur.valid() || !tibia.valid()) return fail("it has no femur and tibia", where);
  for (const char* name : {"acl_femur", "acl_tibia", "blumensaat_posterior", "blumensaat_anterior",
                           "portal_al", "portal_am"})
    if (!find_landmark(the_case, name))
      return fail("it has no landmark " + std::string(name), where,
                  "Use a generated knee, such as builtin:knee");
  return AclKnee(the_case, the_case.bone(femur), the_case.bone(tibia));
}

void AclKnee::spare_softs() {
  softs_W_.clear();
  for (const SoftPart& part : case_->softs)
    if ((part.kind == "meniscus" || part.name == "pcl") && !part.mesh_W.triangles.empty())
      softs_W_.emplace_back(part.mesh_W);
}

double AclKnee::soft_m(const Vec3& p_W) const {
  double least = std::numeric_limits<double>::infinity();
  for (const MeshDistance& part : softs_W_)
    least = std::min(least, part.closest(p_W).signed_distance);
  return least;
}

bool AclKnee::has_mark(std::string_view name) const {
  return find_landmark(*case_, name).has_value();
}

Vec3 AclKnee::mark(std::string_view name) const {
  const auto at = find_landmark(*case_, name);
  return at ? case_->landmarks[*at].p_W : Vec3(Vec3::Zero());
}

// Strides are no longer than the room there is.
bool AclKnee::is_free(const Vec3& from_W, const Vec3& to_W, double radius_m) const {
  constexpr double kLeastStride_m = 0.0005;
  const double length = (to_W - from_W).norm();
  if (!(length > 0)) return gap_m(from_W) > radius_m;
  const Vec3 along = (to_W - from_W) / length;
  for (double at = 0; at < length;) {
    const double room = gap_m(from_W + at * along) - radius_m;
    if (room <= 0) return false;
    at += std::max(room, kLeastStride_m);
  }
  return gap_m(to_W) > radius_m;
}

double AclKnee::way_out(bool of_femur, const Vec3& p_W, const Vec3& direction) const {
  constexpr double kOut_m = 1e-5;
  double way = 0;
  for (int stride = 0; stride < 300; ++stride) {
    const Vec3 at = p_W + way * direction;
    const double inside = -(of_femur ? femur_m(at) : tibia_m(at));
    if (inside < kOut_m) break;
    way += inside;
  }
  return way;
}

Vec3 AclKnee::normal(bool of_femur, const Vec3& p_W) const {
  constexpr double kAside_m = 0.0008;
  Vec3 up;
  for (long k = 0; k < 3; ++k) {
    Vec3 a = p_W, b = p_W;
    a[k] -= kAside_m;
    b[k] += kAside_m;
    up[k] = of_femur ? femur_m(b) - femur_m(a) : tibia_m(b) - tibia_m(a);
  }
  return up.normalized();
}

}  // namespace osteon
