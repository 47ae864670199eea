#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "osteon/scene/case.h"

namespace osteon {

/// What a torn ligament has left at one of its footprints.
struct TornStump {
  std::uint32_t soft = 0;      ///< in Case::softs
  BoneId bone;                 ///< on which it stands
  Vec3 foot_B = Vec3::Zero();  ///< middle of the footprint
  TriMesh mesh_B;              ///< closed, in the bone's frame
};

/// Of ligaments whose surface is in two or more: the part nearest each footprint, smaller ones than
/// a hundredth of the ligament left out. By ligament, then as its attachments are listed. Empty: no
/// ligament of the case is torn through.
std::vector<TornStump> torn_stumps(const Case& the_case);

}  // namespace osteon
