#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "osteon/image/progress.h"
#include "osteon/image/volume.h"
#include "osteon/image/watershed.h"

namespace osteon {

struct SegmentOptions {
  double threshold_hu = 300;
  double smallest_m3 = 1e-7;  ///< smaller pieces are dropped
  bool split = true;          ///< part bodies at their necks
  bool outside = false;       ///< keep parts outside the body too (parts_outside_body)
  NeckOptions necks;
  Progress progress;
};

/// One bone, as far as the picture alone tells.
struct Region {
  std::uint16_t label = 0;
  std::size_t voxels = 0;  ///< marrow included
  VoxelBox box;
};

struct Segmentation {
  LabelVolume labels;
  std::vector<Region> regions;  ///< largest first; region n has the label n + 1
  std::size_t outside = 0;      ///< parts that were left out because they lie outside the body
};

/// What a segmentation of this grid takes at its peak, bytes, the volume included.
double segmentation_bytes(const GridFrame& frame);

/// Bone by threshold, its connected parts without those outside the body, each filled and parted at
/// its necks. Fails when nothing of the smallest size is found.
Result<Segmentation> segment_bone(const Volume& volume, const SegmentOptions& options = {});

/// Numbers the regions anew by size after labels were changed; drops those below `smallest_m3`.
void renumber(Segmentation& segmentation, double smallest_m3);

/// Every label in use, in their order.
std::vector<Region> measure_regions(const LabelVolume& labels);

/// At most `most` points of the region's outer voxels, in Patient, spread evenly over memory.
std::vector<Vec3> boundary_points_P(const Segmentation& segmentation, const Region& region,
                                    std::size_t most);

}  // namespace osteon
