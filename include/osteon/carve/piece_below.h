#pragma once

#include <memory>

#include "osteon/carve/piece_shape.h"
#include "osteon/carve/uncut_field.h"

namespace osteon {

/// What of a piece lay deeper than `depth_m` under the surface of its bone before anything was cut,
/// in the frame of that bone. Of a bone under cartilage depths count from the bone's own surface: 0
/// takes the cartilage off the piece. Null: no node of the piece lies so deep. `bone`: that the
/// piece was part of.
std::shared_ptr<const PieceShape> piece_below(const PieceShape& piece, const UncutField& bone,
                                              double depth_m);

}  // namespace osteon
