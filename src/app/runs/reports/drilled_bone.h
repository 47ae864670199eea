#pragma once

#include <optional>
#include <vector>

#include "osteon/carve/carved_field.h"
#include "osteon/mesh/distance.h"
#include "osteon/physics/acl_tunnels.h"

namespace osteon {

/// The hole for a graft that a bone has, in Bone.
struct DrilledHole {
  /// Its axis, led on out of the bone where the hole opens; as wide as its wall.
  DrilledLine line;
  double length_m = 0;   ///< of its wall
  bool through = false;  ///< it opens on both sides as wide as it is
  /// Of a narrower hole that goes on along the same axis and opens on the far side; 0: none.
  double channel_m = 0;
};

/// Of the round holes of 4 to 14 mm that the surface has where it was cut, the one that holds most;
/// none: there is none. `whole`: the bone that was never drilled, in Bone; `before`: as it was
/// before these cuts. A hole whose axis does not run in bone of that was there already, and does
/// not count. `roundness_m`: see HoleOptions.
std::optional<DrilledHole> find_drilled(const CarvedField& field, const MeshDistance& whole,
                                        const MeshDistance& before, double roundness_m = 0.0003);

/// The round holes of 4 to 14 mm that a bone's mesh has, the one that holds most first; in Bone.
std::vector<DrilledLine> holes_of(const TriMesh& bone, double roundness_m = 0.0003);

}  // namespace osteon
