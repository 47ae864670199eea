#pragma once

#include "osteon/collide/cut_field.h"
#include "osteon/collide/distance_field.h"

namespace osteon {

/// A bone's field as it is now: the immutable one, less what was cut. Both must outlive the view.
///
/// What is left is where both heights are negative. Over a rim, where the nearest place is neither
/// on the bone's surface nor on the hole's wall, the height is the distance to the edge in which
/// the two planes meet: a rim is round to a ball that rolls over it, not pointed.
class FieldView {
 public:
  FieldView(const DistanceField& bone, const CutField* cuts = nullptr) : bone_(bone), cuts_(cuts) {}
  FieldSample at(const Vec3& p_B) const {
    const FieldSample bone = bone_.at(p_B);
    return cuts_ && !cuts_->empty() ? carved(bone, p_B) : bone;
  }
  const Aabb& box() const { return bone_.box(); }

 private:
  FieldSample carved(const FieldSample& bone, const Vec3& p_B) const;

  const DistanceField& bone_;
  const CutField* cuts_;
};

}  // namespace osteon
