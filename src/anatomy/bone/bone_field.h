#pragma once

#include <vector>

#include "bone/near_solid.h"
#include "describe/description.h"
#include "osteon/mesh/local_field.h"

namespace osteon {

/// What a bone fills, in Bone: its parts, hollowed by the neighbours that keep their distance, less
/// its defects. The description must live longer.
class BoneField : public LocalField {
 public:
  BoneField(const AnatomyDescription& anatomy, const BoneDescription& bone);

  double at(const Vec3& p_B) const override;
  Near near(const Vec3& center_B, double radius) const override;

 private:
  /// A neighbour that keeps its distance, ready for evaluation in the frame of the bone it hollows.
  struct Neighbour {
    NearSolid solid;
    Aabb reach_N;  ///< outside this box the neighbour changes nothing
    Mat3 R_NB;
    Vec3 p_NB;
    double gap, blend;
  };
  explicit BoneField(const BoneDescription& bone) : bone_(bone) {}
  static Neighbour neighbour(const BoneDescription& other, const BoneDescription& bone,
                             const Clearance& c);
  void keep_neighbours(const BoneField& from, const Vicinity& where_B, Spread& values);
  void keep_defects(const BoneField& from, const Vicinity& where_B, Spread& values);

  const BoneDescription& bone_;
  NearSolid solid_;
  std::vector<Neighbour> neighbours_;
  std::vector<const Part*> defects_;
};

}  // namespace osteon
