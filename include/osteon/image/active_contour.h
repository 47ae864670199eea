#pragma once

#include <cstddef>
#include <cstdint>

#include "osteon/base/result.h"
#include "osteon/image/progress.h"
#include "osteon/image/volume.h"

namespace osteon {

struct ContourOptions {
  int steps = 15;            ///< the contour moves by at most a voxel in each
  double blur_voxels = 1.0;  ///< before edges are sought, within a slice
  /// Slope of the blurred picture at which an edge holds the contour half, HU a voxel.
  double edge_hu = 120;
  int smoothing = 1;  ///< rounds of curvature smoothing in each step; 0: none
};

struct ContourChange {
  std::size_t gained = 0, lost = 0;  ///< voxels, over all labels
};

/// Moves the outline of every label onto the nearest edge of the picture, slice by slice (constant
/// k): geodesic active contours (Caselles, Kimmel and Sapiro, Int. J. Comput. Vis. 22, 1997), by
/// their morphological form (Marquez-Neila, Baumela and Alvarez, IEEE Trans. Pattern Anal. Mach.
/// Intell. 36, 2014, sections 4 and 5, without balloon force). A label never takes a voxel of
/// another one. `labels` has the volume's size. Fails on other sizes, on options out of range, and
/// when told to stop (labels are then as far as the work had come).
Result<ContourChange> refine_contours(const Volume& volume, LabelVolume& labels,
                                      const ContourOptions& options = {},
                                      const Progress& progress = {});

}  // namespace osteon
