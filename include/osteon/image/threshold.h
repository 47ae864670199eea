#pragma once

#include "osteon/image/volume.h"

namespace osteon {

/// Where soft tissue and bone lie among the values of a scan, HU.
struct BoneLevels {
  double soft_hu = 50;        ///< most frequent value near that of muscle
  double bone_hu = 1000;      ///< mean of the brighter class of what is brighter than soft tissue
  double threshold_hu = 300;  ///< suggested: above it is bone
};

/// Suggests a threshold: half-way from soft tissue to the cut that parts what is brighter than soft
/// tissue into two classes of least variance (Otsu, IEEE SMC 9, 1979).
BoneLevels find_bone_levels(const Volume& volume);

}  // namespace osteon
