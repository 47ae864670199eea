#pragma once

#include <functional>
#include <vector>

#include "tunnel_patch.h"
#include "tunnel_prism.h"
#include "tunnel_rims.h"

namespace osteon::tunnel {

/// Whether a point of the drill's frame lies in bone.
using InBone = std::function<bool(const Vec3& p_A)>;

struct Wall {
  std::vector<Triangle> wall;  ///< faces the axis
  std::vector<Triangle> ends;  ///< flat, face the tunnel
};

/// The prism's surface within bone, between rims that are known. Adds the corners of the ends to
/// the patch. `in_bone` is asked at most once, where no column meets the surface. False where the
/// rims do not fit together.
bool make_wall(Patch& patch, const Prism& prism, const Rims& rims, const InBone& in_bone,
               Wall& wall);

}  // namespace osteon::tunnel
