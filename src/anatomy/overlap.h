#pragma once

#include <string>

#include "osteon/anatomy/generate.h"

namespace osteon {

struct Overlap {
  std::string bone, other;
  double depth = 0;  ///< metres: the deepest vertex of one inside the other
};

/// The deepest overlap of two bones; depth 0 when none meet.
Overlap deepest_overlap(const GeneratedAnatomy& anatomy);

}  // namespace osteon
