#pragma once

#include <cstdint>
#include <vector>

#include "osteon/image/volume.h"
#include "osteon/mesh/distance.h"

namespace osteon {

/// A bone in Patient.
struct ScanTarget {
  MeshDistance distance;
  Aabb box;
};

/// CT number by the signed distance to the nearest bone.
struct ScanProfile {
  double cortical_m = 0, flesh_m = 0;
  double cortical_hu = 0, cancellous_hu = 0, flesh_hu = 0, air_hu = 0;

  double at(double distance_m) const;
  /// Mean over distances within half of `width_m` of `distance_m`.
  double mean(double distance_m, double width_m) const;
  /// True when the profile is flat within `reach_m` of `distance_m`.
  bool flat(double distance_m, double reach_m) const;
};

struct CellsPerVoxel {
  int in_slice, along;
};

/// Works out one slice after the other on cells finer than the voxels, which it averages. Blocks of
/// cells over which the profile is flat take one distance query; at the bone's surface the distance
/// is queried every half millimetre and continued along its gradient.
class SlabScanner {
 public:
  SlabScanner(const std::vector<ScanTarget>& targets, const ScanProfile& profile,
              const GridFrame& frame, CellsPerVoxel cells);
  /// Writes the HU of slice k, without noise.
  void scan(int k, std::int16_t* slice);

 private:
  /// Distance to the nearest bone and its gradient.
  struct Near {
    double distance;
    Vec3 gradient;
  };
  Near nearest(const Vec3& p_P);
  void fill(int i0, int i1, int j0, int j1, int k0, int k1);
  void add(int i, int j, float hu);
  Vec3 cell_center(double i, double j, double k) const;

  const std::vector<ScanTarget>& targets_;
  ScanProfile profile_;
  GridFrame frame_;
  CellsPerVoxel cells_;
  Vec3 cell_m_;
  int slice_ = 0;
  std::size_t last_ = 0;     ///< index of the target that was nearest last
  std::vector<float> sums_;  ///< of each voxel of the slice
};

}  // namespace osteon
