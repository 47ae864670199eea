#include "joint_wall.h"

#include <algorithm>
#include <cmath>

#include "osteon/mesh/isosurface.h"

namespace osteon {
namespace {

constexpr double kWallOff_m = 0.010;  ///< of the wall from bone
constexpr double kRoom_m = 0.006;     ///< around the tip
constexpr double kBlend_m = 0.012;
constexpr double kWallReach_m = 0.060;
constexpr double kWallCell_m = 0.0025;

/// The smaller of two, rounded where they are alike; never changes faster than they do.
double smooth_min(double a, double b) {
  const double h = std::max(kBlend_m - std::abs(a - b), 0.0) / kBlend_m;
  return std::min(a, b) - 0.25 * h * h * kBlend_m;
}

double to_bone_m(const WalledBone& bone, const Vec3& p_W) {
  return bone.surface->closest(bone.X_WB.inverse() * p_W).signed_distance;
}

}  // namespace

Result<TriMesh> joint_wall(std::span<const WalledBone> bones, const Vec3& tip_W) {
  if (!is_finite(tip_W) || tip_W.norm() > 100) return fail("is no place in World", "the tip");
  std::vector<const WalledBone*> near;
  double nearest = kWallReach_m;
  for (const WalledBone& bone : bones) {
    const double d = to_bone_m(bone, tip_W);
    if (d < 0)
      return fail("lies in the bone '" + *bone.name + "'", "the tip",
                  "Choose a place between the bones: 'osteon render' shows them");
    if (d < kWallReach_m + kWallOff_m) near.push_back(&bone);
    nearest = std::min(nearest, d);
  }
  // Negative inside the room. Where the tip is far from bone the wall keeps clear of it.
  const double off = std::max(kWallOff_m, nearest + kRoom_m);
  const auto room = [&](const Vec3& p_W) {
    double to_bone = 2 * kWallReach_m;
    for (const WalledBone* bone : near) to_bone = smooth_min(to_bone, to_bone_m(*bone, p_W));
    return std::max(to_bone - off, (p_W - tip_W).norm() - kWallReach_m);
  };
  const Vec3 half = Vec3::Constant(kWallReach_m + 4 * kWallCell_m);
  IsosurfaceOptions options;
  options.cell_m = kWallCell_m;
  return isosurface(room, {tip_W - half, tip_W + half}, options);
}

}  // namespace osteon
