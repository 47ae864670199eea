#pragma once

#include <optional>
#include <vector>

#include "osteon/scene/case.h"
#include "osteon/scene/state.h"

namespace osteon {

/// How skin that covers a knee has moved with the bones under it, away from rest. All is in World.
struct CoverMotion {
  Pose upper;                         ///< motion of what lies wholly on the upper bone
  Vec3 axis = Vec3::UnitZ();          ///< unit; the lower bone turns about it against the upper one
  Vec3 point = Vec3::Zero();          ///< of the axis at rest
  double angle_rad = 0, along_m = 0;  ///< by so much, and so far along it
  /// Where a place of the skin at rest has gone, `share` of it on the lower bone.
  Vec3 moved(const Vec3& p_W, double share) const;
};

/// Skin that goes over a knee bends with it: what lies on the thigh goes with the femur and what
/// lies on the shank with the tibia. Between them each place takes a share of the turn of one bone
/// against the other, as a screw about their common axis, so that skin stays smooth and as thick as
/// it was. The share is a matter of the place at rest alone.
class LimbCover {
 public:
  /// The skin about the place of a portal goes with one bone wholly, as it is felt.
  struct Whole {
    Vec3 center_W = Vec3::Zero();
    double share = 1;  ///< 1: with the lower bone, 0: with the upper one
  };
  /// Half of the stretch between both, along the limb: in front, where much skin shifts over the
  /// knee, and in the hollow of the knee, where thigh and shank of a bent knee lie close together.
  static constexpr double kHalfInFront_m = 0.090, kHalfBehind_m = 0.060;
  static constexpr double kFront_m = 0.050;      ///< so far in front of the middle it is the former
  static constexpr double kWholeTo_m = 0.024;    ///< from the place of a portal
  static constexpr double kWholeFrom_m = 0.120;  ///< beyond this the portal changes nothing

  /// Of a case with a femur and a tibia; none otherwise.
  static std::optional<LimbCover> over(const Case& the_case);
  double share(const Vec3& p_W) const;
  /// `rest_X_WB` of all bones of the case.
  CoverMotion motion(const BoneSnapshot& bones, std::span<const Pose> rest_X_WB) const;

  const Vec3& towards_lower_W() const { return towards_lower_W_; }  ///< unit
  const Vec3& forwards_W() const { return forwards_W_; }            ///< unit; zero: a straight limb
  const Vec3& middle_W() const { return middle_W_; }  ///< of the plane where both have half
  const std::vector<Whole>& wholes() const { return wholes_; }
  /// The bone under the skin in front of the joint, which glides under it as the joint bends; none:
  /// the case has none.
  BoneId kneecap() const { return kneecap_; }

 private:
  std::size_t upper_ = 0, lower_ = 0;
  BoneId kneecap_;
  Vec3 middle_W_ = Vec3::Zero(), towards_lower_W_ = Vec3::UnitZ(), forwards_W_ = Vec3::Zero();
  std::vector<Whole> wholes_;
};

}  // namespace osteon
