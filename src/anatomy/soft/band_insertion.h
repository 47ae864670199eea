#pragma once

#include <vector>

#include "soft/soft_layer.h"

namespace osteon {

/// A place along a band's middle line, metres.
struct BandStation {
  Vec3 p = Vec3::Zero();
  double width = 0, thickness = 0;
};

/// The stations with which a band that arrives at `end` along the unit `onward` ends on its bone.
/// As far as it arrives along the surface it goes on over it for a short footprint, narrows to a
/// rounded tip and sinks in part. Where it arrives straight down it goes on until it lies wholly in
/// the bone.
std::vector<BandStation> insertion(const BandStation& end, const Vec3& onward,
                                   const SoftGround& bone);

/// Unit directions in which a band's thickness is measured, turned from the wanted ones (unit, one
/// a station) towards the normal of a bone that is near, wholly where the band lies on it. A bone
/// whose surface stands about square to the wanted direction does not turn it.
std::vector<Vec3> turned_flat_on_bone(const std::vector<BandStation>& stations,
                                      std::vector<Vec3> wanted, const GroundView& ground);

}  // namespace osteon
