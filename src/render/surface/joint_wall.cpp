#include "surface/joint_wall.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "osteon/mesh/isosurface.h"
#include "osteon/mesh/measure.h"

namespace osteon {
namespace {

/// Of the wall from bone: half as wide as the slenderest bone of the joint, within these.
constexpr double kWallOff_m = 0.010, kLeastWallOff_m = 0.0055;
constexpr double kRoom = 0.6;  ///< of that, around the tip
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

/// Small bones have a narrow joint.
double wall_off_m(const std::vector<const WalledBone*>& bones) {
  double slenderest = 2 * kWallOff_m;
  for (const WalledBone* bone : bones)
    slenderest = std::min(slenderest, bounds(bone->surface->mesh()).extent().minCoeff());
  return std::clamp(0.5 * slenderest, kLeastWallOff_m, kWallOff_m);
}

/// Negative inside the room: nearer than `off_m` to bone, and than kWallReach_m to the tip. Its
/// value changes no faster than the place, so the value in the middle of a ball tells the sign in
/// all of it, or which bones can matter there: one that is farther than another by the blend leaves
/// the smooth minimum as it is.
class RoomField : public LocalField {
 public:
  RoomField(std::vector<const WalledBone*> bones, const Vec3& tip_W, double off_m)
      : bones_(std::move(bones)), tip_W_(tip_W), off_m_(off_m) {}

  double at(const Vec3& p_W) const override {
    double to_bone = 2 * kWallReach_m;
    for (const WalledBone* bone : bones_) to_bone = smooth_min(to_bone, to_bone_m(*bone, p_W));
    return clipped(to_bone, p_W);
  }

  Near near(const Vec3& center_W, double radius_m) const override {
    if ((center_W - tip_W_).norm() - kWallReach_m > radius_m) return {1, nullptr};
    std::vector<double> away;
    double least = 2 * kWallReach_m, to_bone = least;
    for (const WalledBone* bone : bones_) {
      away.push_back(to_bone_m(*bone, center_W));
      to_bone = smooth_min(to_bone, away.back());
      least = std::min(least, away.back());
    }
    const double value = clipped(to_bone, center_W);
    if (std::abs(value) > radius_m) return {value > 0 ? 1 : -1, nullptr};
    std::vector<const WalledBone*> left;
    for (std::size_t k = 0; k < bones_.size(); ++k)
      if (away[k] - least <= kBlend_m + 2 * radius_m) left.push_back(bones_[k]);
    if (left.size() == bones_.size()) return {};
    return {0, std::make_unique<RoomField>(std::move(left), tip_W_, off_m_)};
  }

 private:
  double clipped(double to_bone, const Vec3& p_W) const {
    return std::max(to_bone - off_m_, (p_W - tip_W_).norm() - kWallReach_m);
  }

  std::vector<const WalledBone*> bones_;
  Vec3 tip_W_;
  double off_m_;
};

}  // namespace

Result<TriMesh> joint_wall(std::span<const WalledBone> bones, const Vec3& tip_W) {
  if (!is_finite(tip_W) || tip_W.norm() > 100) return fail("is not a position in World", "the tip");
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
  const double usual = wall_off_m(near);
  const double off = std::max(usual, nearest + kRoom * usual);
  const RoomField room(std::move(near), tip_W, off);
  const Vec3 half = Vec3::Constant(kWallReach_m + 4 * kWallCell_m);
  IsosurfaceOptions options;
  options.cell_m = kWallCell_m;
  return isosurface(room, {tip_W - half, tip_W + half}, options);
}

}  // namespace osteon
