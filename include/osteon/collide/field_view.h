#pragma once

#include <cstdint>

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
  /// A height rises by no more than this a metre: a distance rises by 1, a spline overshoots a
  /// little.
  static constexpr double kSteepest = 1.25;
  /// `asked`: counts how often a carved bone is looked at, for who has so many looks and no more.
  FieldView(const DistanceField& bone, const CutField* cuts = nullptr,
            std::uint32_t* asked = nullptr)
      : bone_(bone), cuts_(cuts && !cuts->empty() ? cuts : nullptr), asked_(asked) {}
  FieldSample at(const Vec3& p_B) const {
    if (cuts_ && asked_) ++*asked_;
    return again(p_B);
  }
  /// The same of a place whose distance was asked for just now: not counted again.
  FieldSample again(const Vec3& p_B) const {
    const FieldSample bone = bone_.at(p_B);
    return cuts_ ? carved(bone, p_B) : bone;
  }
  /// Its distance alone, the same bits in less time.
  double distance_at(const Vec3& p_B) const {
    if (!cuts_) return bone_.distance_at(p_B);
    if (asked_) ++*asked_;
    return carved_distance(p_B);
  }
  /// Whether anything was cut out of it: then looks cost twice as much.
  bool is_carved() const { return cuts_ != nullptr; }
  const Aabb& box() const { return bone_.box(); }

 private:
  FieldSample carved(const FieldSample& bone, const Vec3& p_B) const;
  double carved_distance(const Vec3& p_B) const;

  const DistanceField& bone_;
  const CutField* cuts_;  ///< null: nothing was cut
  std::uint32_t* asked_;
};

}  // namespace osteon
