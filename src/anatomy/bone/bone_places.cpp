#include "bone/bone_places.h"

#include <optional>
#include <vector>

#include "osteon/mesh/distance.h"

namespace osteon {

void lay_on_bones(const AnatomyDescription& anatomy, GeneratedAnatomy& grown) {
  std::vector<std::optional<MeshDistance>> surfaces(grown.bones.size());
  for (std::size_t i = 0; i < anatomy.landmarks.size() && i < grown.landmarks.size(); ++i) {
    const std::optional<std::size_t>& bone = anatomy.landmarks[i].on_bone;
    if (!bone || *bone >= grown.bones.size()) continue;
    const GeneratedBone& ground = grown.bones[*bone];
    if (!surfaces[*bone]) surfaces[*bone].emplace(ground.mesh);
    Vec3& p_W = grown.landmarks[i].p_W;
    p_W = ground.X_WB * surfaces[*bone]->closest(ground.X_WB.inverse() * p_W).point;
  }
}

}  // namespace osteon
