#pragma once

#include <optional>

#include "osteon/collide/round_box.h"
#include "osteon/physics/skin_setup.h"

namespace osteon {

/// Where a box is on a patch of skin at rest; the frame is the sheet's.
struct BoxOnSkin {
  double deep_m = 0;         ///< of its deepest place under the skin; above it negative
  double radius_m = 0;       ///< of a disc as large as what of the box presses the skin
  Vec3 core = Vec3::Zero();  ///< in the box's axes: the middle of that, as deep as the deepest
  Vec3 p_S = Vec3::Zero();   ///< on the skin there
  Vec3 n_S = Vec3::UnitZ();  ///< unit, out of the skin
};

/// What of the box presses is what would be as deep as half of its deepest place in skin that stays
/// at rest: of a ball on an elastic body this is its circle of contact (Hertz), of a face that lies
/// flat the whole face, of an edge a strip. Nothing: no part of the box is over the patch.
/// Allocates nothing.
std::optional<BoxOnSkin> box_on_skin(const SkinPatch& patch, const RoundBox& box_S);

/// How near to the border of a patch its skin is felt: 0 there, 1 from 3 mm inside on.
double felt_share(const SkinPatch& patch, const SheetPoint& p);

}  // namespace osteon
