#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/collide/capsule_contact.h"
#include "osteon/mesh/distance.h"
#include "osteon/scene/case.h"

namespace osteon {

/// Bones of a knee as obstacles, where they are at rest.
class AclKnee {
 public:
  /// Fails where there is no femur or tibia, or a landmark is missing.
  static Result<AclKnee> make(const Case& the_case);

  /// Where it is at rest.
  const Case& whole() const { return *case_; }
  Vec3 mark(std::string_view name) const;
  bool has_mark(std::string_view name) const;
  /// Distance to a bone, negative inside.
  double femur_m(const Vec3& p_W) const { return gap(femur_, X_WF_, p_W); }
  double tibia_m(const Vec3& p_W) const { return gap(tibia_, X_WT_, p_W); }
  double gap_m(const Vec3& p_W) const { return std::min(femur_m(p_W), tibia_m(p_W)); }
  /// From now on soft_m() knows the menisci and the other cruciate ligament.
  void spare_softs();
  bool spares_softs() const { return !softs_W_.empty(); }
  /// Distance to what is spared, negative inside; infinite: nothing is.
  double soft_m(const Vec3& p_W) const;
  /// A direction of a right knee stretched out (x to the foot, y to the other leg, z to the front),
  /// as this knee's femur or tibia has it.
  Vec3 femoral(Vec3 d) const { return X_WF_.rotate(sided(d)); }
  Vec3 tibial(Vec3 d) const { return X_WT_.rotate(sided(d)); }
  /// Whether a rod is free of bone between two places.
  bool is_free(const Vec3& from_W, const Vec3& to_W, double radius_m) const;
  /// From a place inside along a unit direction to where it leaves that bone; 0: it is not inside.
  double way_out(bool of_femur, const Vec3& p_W, const Vec3& direction) const;
  /// The place on the femur's surface next to a place.
  Vec3 on_femur(const Vec3& p_W) const {
    return X_WF_ * femur_.closest(X_WF_.inverse() * p_W).point;
  }
  /// Whether the bone has a tunnel of an earlier reconstruction.
  bool has_old(bool of_femur) const { return (of_femur ? old_socket_ : old_tunnel_).has_value(); }
  /// Bone that is left between that and a new one from one place to another, below 0: none.
  double to_old_m(bool of_femur, const Vec3& from_W, const Vec3& to_W, double radius_m) const;
  /// The outward normal of a bone's surface next to a place, unit.
  Vec3 normal(bool of_femur, const Vec3& p_W) const;

 private:
  AclKnee(const Case& the_case, const Bone& femur, const Bone& tibia);
  static double gap(const MeshDistance& bone, const Pose& X_WB, const Vec3& p_W) {
    return bone.closest(X_WB.inverse() * p_W).signed_distance;
  }
  Vec3 sided(Vec3 d) const {
    if (left_) d.y() = -d.y();
    return d;
  }

  std::optional<Capsule> old_between(std::string_view from, std::string_view to) const;

  const Case* case_;
  MeshDistance femur_, tibia_;
  std::vector<MeshDistance> softs_W_;
  Pose X_WF_, X_WT_;
  bool left_ = false;
  std::optional<Capsule> old_socket_, old_tunnel_;  ///< World
};

}  // namespace osteon
