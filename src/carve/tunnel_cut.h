#pragma once

#include <vector>

#include "tunnel_patch.h"
#include "tunnel_prism.h"
#include "tunnel_wall.h"

namespace osteon::tunnel {

/// A patch less the drill.
struct CutPatch {
  std::vector<Vec3> points_A;       ///< those of the patch, then new ones
  std::vector<Triangle> triangles;  ///< surface, wall and ends
  std::vector<std::vector<std::uint32_t>> rims;
  double bottom_m2 = 0;
  double clearance = 0;  ///< of all that was decided, m; 0: it did not fit together
  Placing placing;
  int sides = 0;
};

/// The drill as it is meant: radius and ends, m.
struct Drill {
  double radius = 0, start = 0, end = 0;
};

/// Cuts with the drill placed first as `like`, then as needed, until nothing comes closer than
/// 0.1 um to being decided otherwise; of 48 placings at most the clearest. Clearance 0: none fits.
CutPatch cut_patch(const Patch& patch, const Drill& drill, const Placing& like,
                   const InBone& in_bone);

}  // namespace osteon::tunnel
