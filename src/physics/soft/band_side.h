#pragma once

#include "osteon/physics/soft_state.h"

namespace osteon {

/// How a tool's part lies by a band.
struct BandSide {
  Vec3 nhat_W = Vec3::UnitZ();  ///< from the band to the part, on the side where it came
  double gap_m = 0;             ///< between the surfaces on that side
  bool beyond = false;          ///< the part's middle line is on the other side of the band's
};

/// Of a part that has just come near.
BandSide first_side(const SoftBand& band, const BandSpan& span, const RoundBox& part_W);

/// Of one that was at `nhat_W` a step ago: it keeps its side when it goes through the band's rest
/// place, and is followed round the band when it slides off. The side turns by 0.1 rad a step at
/// most.
BandSide next_side(const SoftBand& band, const BandSpan& span, const RoundBox& part_W,
                   const Vec3& nhat_W);

}  // namespace osteon
