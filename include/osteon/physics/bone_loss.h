#pragma once

#include "osteon/base/types.h"

namespace osteon {

/// What a rigid body has lost of its mass, in the bone's frame B.
struct BoneLoss {
  double mass_kg = 0;
  Vec3 first_B = Vec3::Zero();   ///< sum of m r, kg m
  Mat3 second_B = Mat3::Zero();  ///< sum of m r r^T, kg m^2
  friend bool operator==(const BoneLoss& a, const BoneLoss& b) {
    return a.mass_kg == b.mass_kg && a.first_B == b.first_B && a.second_B == b.second_B;
  }
};

/// Bone and cartilage that are gone since a session began.
struct GoneBone {
  double all_m3 = 0;
  double vascular_m3 = 0;  ///< of that, soft bone and marrow
};

}  // namespace osteon
