#pragma once

#include "osteon/image/volume.h"
#include "osteon/mesh/bone_surface.h"

namespace osteon {

/// A label as a field that is negative inside, about metres near its surface, zero where the grey
/// values cross the threshold. Points are in the voxel frame's directions, metres from voxel (0, 0,
/// 0) of the whole volume.
class LabelField {
 public:
  LabelField(const Volume& volume, const LabelVolume& labels, std::uint16_t label,
             const VoxelBox& box, double threshold_hu);
  double operator()(const Vec3& p_V) const;
  /// Holds the whole surface and room around it.
  Aabb box_V() const;

 private:
  Grid<float> field_;  ///< with an empty voxel all around
  Vec3 first_V_ = Vec3::Zero();
};

}  // namespace osteon
