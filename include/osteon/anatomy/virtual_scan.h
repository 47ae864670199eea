#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "osteon/image/progress.h"
#include "osteon/image/tissue.h"
#include "osteon/image/volume.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

struct ScannedBone {
  const TriMesh* mesh = nullptr;  ///< closed, outward; in Bone
  Pose X_WB;
};

/// A soft part, or the skin: the outline of all flesh.
struct ScannedSoft {
  std::string name;                 ///< for errors
  std::string kind;                 ///< "cartilage", "meniscus", ..., "skin"
  std::string tissue;               ///< its name in the tissue table
  const TriMesh* mesh_W = nullptr;  ///< closed, outward; in World
};

struct ScannedBody {
  std::span<const ScannedBone> bones;  ///< at least one
  std::span<const ScannedSoft> softs = {};
};

struct ScanOptions {
  double spacing_m = 0.0005;   ///< within a slice
  double slice_m = 0.0005;     ///< thickness of a slice and distance to the next
  double noise_hu = 30;        ///< standard deviation of each voxel
  double psf_m = 0.0006;       ///< full width at half maximum of the point spread
  double cortical_m = 0.0012;  ///< thickness of the cortical shell (D)
  double flesh_m = 0.008;      ///< muscle around bones that no skin encloses; air beyond
  double skin_m = 0.0015;      ///< thickness of the skin (D)
  double fat_m = 0.002;        ///< of the fat under it (D)
  std::uint64_t seed = 1;
  Progress progress;
};

/// How a case's World lies in the scanner's Patient (LPS): hand stretched out overhead, palm down,
/// so that slices are cut across the forearm: x_P = y_W, y_P = z_W, z_P = x_W.
Pose scanner_pose_PW();

/// Computes the CT volume of what a case holds: HU of each tissue, averaged over each voxel,
/// blurred by the point spread, with normal noise. The same input gives the same values.
///
/// Bone has a cortical shell around cancellous bone. Where parts overlap, the first of these is
/// seen: bone, cartilage, meniscus and disc, ligament, tendon, fat, and last what the skin
/// encloses, by its depth: skin, fat, muscle. Outside is air. Without a skin, and around bone that
/// reaches out of it, all within `flesh_m` of the bone is muscle.
///
/// Fails when there is no bone, a soft part is not closed or of an unknown kind, a tissue is
/// missing in the table, or the grid would be too large.
Result<Volume> virtual_scan(const ScannedBody& body, const TissueTable& tissues,
                            const ScanOptions& options = {});

}  // namespace osteon
