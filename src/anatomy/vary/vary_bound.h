#pragma once

#include <functional>
#include <string>
#include <vector>

#include "describe/description.h"

namespace osteon {

/// How a step of a variation table moves what is bound to a bone that it moves.
struct BoundMove {
  std::function<Vec3(const Vec3&)> point_W;
  std::function<void(Primitive&)> part_W;
  double scale = 1;  ///< of the lengths of soft parts and of blends
};

/// Moves the landmarks that are bound to the named bones ("*": to any), and the points and parts of
/// soft parts and joints that are.
void move_bound(AnatomyDescription& anatomy, const std::vector<std::string>& bones,
                const BoundMove& move);

}  // namespace osteon
