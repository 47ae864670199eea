#pragma once

#include <cstdint>
#include <span>

#include "osteon/image/progress.h"
#include "osteon/image/tissue.h"
#include "osteon/image/volume.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

struct ScannedBone {
  const TriMesh* mesh = nullptr;  ///< closed, outward; in Bone
  Pose X_WB;
};

struct ScanOptions {
  double spacing_m = 0.0005;   ///< within a slice
  double slice_m = 0.0005;     ///< thickness of a slice and distance to the next
  double noise_hu = 30;        ///< standard deviation of each voxel
  double psf_m = 0.0006;       ///< full width at half maximum of the point spread
  double cortical_m = 0.0012;  ///< thickness of the cortical shell (D)
  double flesh_m = 0.008;      ///< soft tissue around the bones; air beyond
  std::uint64_t seed = 1;
  Progress progress;
};

/// How a case's World lies in the scanner's Patient (LPS): hand stretched out overhead, palm down,
/// so that slices are cut across the forearm: x_P = y_W, y_P = z_W, z_P = x_W.
Pose scanner_pose_PW();

/// Computes the CT volume of the bones: HU of each tissue by the distance to the bone's surface
/// (shell of cortical bone, cancellous core, muscle, air), averaged over each voxel, blurred by the
/// point spread, with normal noise. The same input gives the same values.
Result<Volume> virtual_scan(std::span<const ScannedBone> bones, const TissueTable& tissues,
                            const ScanOptions& options = {});

}  // namespace osteon
