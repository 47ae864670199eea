#pragma once

#include <string>

#include "bone/placed_bones.h"
#include "osteon/anatomy/generate.h"

namespace osteon {

struct Overlap {
  std::string bone, other;
  double depth = 0;  ///< metres: the deepest vertex of one inside the other
};

/// The deepest overlap of two bones, which stand as `placed`; depth 0 when none meet.
Overlap deepest_overlap(const GeneratedAnatomy& anatomy, const PlacedBones& placed,
                        const GenerateOptions& options);

}  // namespace osteon
