#pragma once

#include "osteon/base/result.h"
#include "osteon/image/volume.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

struct BoneSurfaceOptions {
  double threshold_hu = 300;  ///< by which the label was found
  double soft_hu = 50;        ///< of what lies around bone
  double cell_m = 0;          ///< of the surface's grid; 0: the voxels' smallest spacing
  double decimate_m = 0.00005;
};

/// Surface of one label in Patient: closed, outward. The grey values place it between voxels: first
/// where the threshold is crossed, then, vertex by vertex along the normal, where the value is half
/// way from soft tissue to the cortical peak inside, which stays unbiased by blur and by the choice
/// of threshold (full width at half maximum; Prevrhal et al., Phys. Med. Biol. 44, 1999). Then
/// Taubin smoothing and decimation. `box` holds the label's voxels.
Result<TriMesh> bone_surface(const Volume& volume, const LabelVolume& labels, std::uint16_t label,
                             const VoxelBox& box, const BoneSurfaceOptions& options = {});

}  // namespace osteon
