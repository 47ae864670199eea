#include "open_sight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "osteon/scene/stumps.h"

namespace osteon {
namespace {

constexpr double kSight_m = 0.0004;                   // room about a line of sight
constexpr double kOpen_m = 0.009, kOpenShare = 0.65;  // free of everything, of half the field
constexpr int kOpenRays = 8;

// How a part has moved away from rest; none: its bones have not moved alike.
std::optional<Pose> moved_with(const SoftPart& part, const Case& at_rest,
                               const BoneSnapshot& bones) {
  constexpr double kAlike_m = 1e-4, kAlike_rad = 1e-3;
  std::optional<Pose> moved;
  for (const BoneId bone : part.bones) {
    if (bone.index >= bones.count) continue;
    const Pose one = bones.bones[bone.index].X_WB * at_rest.bone(bone).X_WB.inverse();
    if (!moved)
      moved = one;
    else if ((moved->p - one.p).norm() > kAlike_m || moved->q.angularDistance(one.q) > kAlike_rad)
      return std::nullopt;
  }
  return moved ? moved : Pose{Vec3::Zero(), Quat::Identity()};
}

}  // namespace

OpenSight::OpenSight(const AclKnee& knee, const Case& at_rest, const BoneSnapshot& bones)
    : knee_(knee) {
  std::vector<std::uint32_t> torn;
  for (const TornStump& stump : torn_stumps(at_rest)) torn.push_back(stump.soft);
  for (std::uint32_t s = 0; s < at_rest.softs.size(); ++s) {
    const SoftPart& part = at_rest.softs[s];
    const bool hides =
        part.kind == "meniscus" || part.kind == "cartilage" || part.kind == "ligament";
    if (!hides || std::find(torn.begin(), torn.end(), s) != torn.end()) continue;
    if (const auto moved = moved_with(part, at_rest, bones))
      parts_.push_back({MeshDistance(part.mesh_W), moved->inverse()});
  }
}

double OpenSight::gap_m(const Vec3& p_W) const {
  double least = knee_.gap_m(p_W);
  for (const Part& part : parts_)
    least = std::min(least, part.mesh.closest(part.X_rest * p_W).signed_distance);
  return least;
}

// Strides are no longer than the room there is, and no shorter than kStride_m, so it ends.
bool OpenSight::is_in_sight(const Vec3& eye_W, const Vec3& to_W) const {
  constexpr double kStride_m = 0.0005;
  const double length = (to_W - eye_W).norm();
  for (double at = 0; at < length;) {
    const double room = gap_m(eye_W + at / length * (to_W - eye_W)) - kSight_m;
    if (room <= 0) return false;
    at += std::max(room, kStride_m);
  }
  return true;
}

bool OpenSight::is_open(const ScopeView& view, const ScopeOptics& optics) const {
  const Vec3 side = view.along_W.cross(view.up_W);
  const double lean = std::tan(kOpenShare * optics.half_field_rad);
  for (int k = 0; k < kOpenRays; ++k) {
    const double angle = 2 * std::numbers::pi * k / kOpenRays;
    const Vec3 ray =
        (view.along_W + lean * (std::cos(angle) * side + std::sin(angle) * view.up_W)).normalized();
    if (!is_in_sight(view.eye_W, view.eye_W + kOpen_m * ray)) return false;
  }
  return is_in_sight(view.eye_W, view.eye_W + kOpen_m * view.along_W);
}

}  // namespace osteon
