#pragma once

#include <vector>

#include "bone/near_solid.h"
#include "describe/description.h"
#include "osteon/mesh/local_field.h"

namespace osteon {

/// The outline of flesh over bones that stand as `poses` says (X_WB), in World. Of a bone its own
/// parts count, which are near enough and quick. Description and bones must live longer.
class SkinField : public LocalField {
 public:
  SkinField() = default;  ///< no flesh, no bones
  SkinField(const SkinDescription& skin, const std::vector<BoneDescription>& bones,
            const std::vector<Pose>& poses);

  double at(const Vec3& p_W) const override;
  Near near(const Vec3& center_W, double radius) const override;

  /// Holds all of it.
  const Aabb& bounds_W() const { return box_W_; }

 private:
  struct Bone {
    NearSolid solid;
    Aabb box_W;
    Mat3 R_BW;
    Vec3 p_BW;
  };
  static Bone place(const BoneDescription& bone, const Pose& X_WB);
  void keep_bones(const SkinField& from, const Vicinity& where_W, Spread& values);
  void keep_cuts(const SkinField& from, const Vicinity& where_W, Spread& values);

  double offset_ = 0, blend_ = 0;
  Aabb box_W_;
  NearSolid flesh_;
  std::vector<Bone> bones_;
  std::vector<const Part*> cuts_;
};

}  // namespace osteon
