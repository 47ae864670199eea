#pragma once

#include <cstddef>

#include "osteon/base/types.h"
#include "osteon/mesh/tri_mesh.h"

namespace osteon {

/// How far two surfaces lie apart after one has been laid over the other.
struct Likeness {
  double mean_m = 0;  ///< mean distance, both ways: of each surface's points to the other surface
  double p95_m = 0;   ///< 95th percentile of the same distances
  double scale = 1;   ///< by which the bone was scaled to lie over the reference
};

struct LikenessOptions {
  /// Points on each surface.
  std::size_t samples = 3000;
  /// Only this length of the bone's end is compared, m, measured along its principal axis from its
  /// farthest point; 0 compares all of it. For bones that are sawn through or of which one end
  /// counts. The same end is sought on both ends of the reference.
  double end_m = 0;
  /// In the bone's frame, any vector from its middle about towards that end.
  Vec3 towards_end_B = Vec3::Zero();
};

/// Lays `bone` over `reference` by a similarity (turn, shift and one scale, never a mirror;
/// iterated closest points both ways, Besl and McKay 1992, Umeyama 1991; started from the principal
/// axes laid over each other in every proper way) and measures how far they lie apart, in the
/// reference's metres. Either mesh may be a soup of triangles; neither may be without area. The
/// same meshes give the same figures.
Likeness compare_surfaces(const TriMesh& bone, const TriMesh& reference,
                          const LikenessOptions& options = {});

}  // namespace osteon
