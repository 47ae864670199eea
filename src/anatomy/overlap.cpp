#include "overlap.h"

#include <vector>

#include "osteon/anatomy/bone_gaps.h"

namespace osteon {

Overlap deepest_overlap(const GeneratedAnatomy& anatomy) {
  std::vector<TriMesh> meshes_W;
  for (const GeneratedBone& bone : anatomy.bones) {
    meshes_W.push_back(bone.mesh);
    for (Vec3& v : meshes_W.back().vertices) v = bone.X_WB * v;
  }
  Overlap deepest;
  for (const BoneGap& gap : bone_gaps(meshes_W, 0))
    if (-gap.gap_m > deepest.depth)
      deepest = {anatomy.bones[gap.first].name, anatomy.bones[gap.second].name, -gap.gap_m};
  return deepest;
}

}  // namespace osteon
