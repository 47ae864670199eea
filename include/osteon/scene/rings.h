#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "osteon/base/types.h"
#include "osteon/scene/case.h"

namespace osteon {

/// The most loose rings of a case: their state has a fixed size.
inline constexpr std::size_t kMaxRings = 8;

/// A ring that lies loose: a bone named "ring_1", "ring_2" ... whose hole looks along z of Bone.
struct RingShape {
  std::uint32_t bone = 0;
  Vec3 center_B = Vec3::Zero();
  double middle_m = 0;  ///< radius of the middle line of what surrounds the hole
  double thick_m = 0;   ///< of what surrounds the hole
};

/// An upright peg: a bone named "peg_1", "peg_2" ..., at rest.
struct RingPeg {
  Vec3 top_W = Vec3::Zero();  ///< middle of its top
  double radius_m = 0;
  double low_z_m = 0;  ///< where it begins
};

/// Rings, the pegs on which they hang, and what else they can lie on: the other bones, at rest.
struct RingSet {
  struct Ground {
    const Hull* piece = nullptr;  ///< of the case, which must outlive the set
    Pose X_BW;
    Aabb box_W;
  };
  std::vector<RingShape> rings;
  std::vector<RingPeg> pegs;
  std::vector<Ground> grounds;
};

/// Rings and pegs of a case; none of either: the set is empty. Of more than kMaxRings the first
/// ones are loose.
RingSet find_rings(const Case& the_case);
/// Whether the bone is one of those rings: no instrument feels it, and it hides nothing.
bool is_loose_ring(const Case& the_case, std::uint32_t bone);

/// The peg that stands in a ring's hole, whose middle is at `center_W`; null: none.
const RingPeg* peg_in_ring(const RingSet& set, const RingShape& ring, const Vec3& center_W);

/// Height of the middle of a flat ring that has come straight down from `center_W`: on what stands
/// under it, or on another ring. `centers_W`: of all rings. Without ground far below.
double rest_height_m(const RingSet& set, std::size_t ring, const Vec3& center_W,
                     std::span<const Vec3> centers_W);

}  // namespace osteon
