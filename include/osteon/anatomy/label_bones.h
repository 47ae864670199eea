#pragma once

#include <string>
#include <vector>

#include "osteon/anatomy/generate.h"
#include "osteon/anatomy/name_bones.h"
#include "osteon/image/segment.h"

namespace osteon {

/// One bone of a scan.
struct LabelledBone {
  std::string name;  ///< of the model, or "bone_1", ... where the model has none for it
  std::uint16_t label = 0;
  std::size_t voxels = 0;
  VoxelBox box;
};

struct LabelledBones {
  LabelVolume labels;
  std::vector<LabelledBone> bones;
  ModelFit fit;             ///< of the model as a whole
  bool recognised = false;  ///< the scan shows the model's anatomy
  int parted = 0;           ///< regions that held several bones
  int joined = 0;           ///< regions that were pieces of a bone
};

/// Names the regions of a scan after the bones of a model, parts regions that hold several of them
/// (seeds inside the fitted model bones, grown along the brighter voxels) and joins pieces that
/// touch. Where the scan does not show the model's anatomy, regions stay as they are.
LabelledBones label_bones(const Volume& volume, Segmentation segmentation,
                          const GeneratedAnatomy& model);

}  // namespace osteon
