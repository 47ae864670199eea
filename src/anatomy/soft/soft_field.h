#pragma once

#include <optional>
#include <vector>

#include "describe/description.h"
#include "osteon/base/result.h"
#include "soft/soft_band.h"

namespace osteon {

/// A surface that other soft parts give way to.
struct Obstacle {
  const MeshDistance* surface;
  Aabb box;
  std::optional<std::size_t> bone = {};  ///< that it is, or lies on
};

/// What a soft part of this shape fills, as a closed surface in World: that of the band or the
/// parts, less all that lies deeper than `sink` in an obstacle. Only its largest piece is kept.
/// A part with defects keeps as many pieces as its description says.
Result<TriMesh> grow_band(const LaidBand& band, double sink, const SoftDescription& soft,
                          const std::vector<Obstacle>& obstacles);
/// Between the obstacles of two bones a volume is nowhere thinner than its `least`: it sinks into
/// both by the same.
Result<TriMesh> grow_volume(const VolumeDescription& volume, const SoftDescription& soft,
                            const std::vector<Obstacle>& obstacles);
/// The outline of flesh over the bones, which stand as `poses` says (X_WB).
Result<TriMesh> grow_skin(const SkinDescription& skin, double cell_m,
                          const std::vector<BoneDescription>& bones,
                          const std::vector<Pose>& poses);

}  // namespace osteon
