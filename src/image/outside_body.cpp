#include "osteon/image/outside_body.h"

#include <algorithm>
#include <cmath>

#include "label_mask.h"
#include "osteon/image/distance_map.h"

namespace osteon {
namespace {

constexpr std::int16_t kAirBelow_hu = -400;
// Nearer voxels hold some of the part itself; farther ones may lie beyond the skin over a bone.
constexpr double kFrom_m = 0.001, kTo_m = 0.003;

enum class Around { kNothing, kTissue, kAir };

// Coarse voxels: at least two of the smallest steps.
double farthest_looked_m(const GridFrame& frame) {
  return std::max(kTo_m, 2 * frame.spacing_m.minCoeff());
}

VoxelBox looked_at(const Component& part, const GridFrame& frame) {
  VoxelBox box = part.box;
  for (std::size_t a = 0; a < 3; ++a) {
    const int margin = static_cast<int>(
        std::ceil(farthest_looked_m(frame) / frame.spacing_m[static_cast<Eigen::Index>(a)]));
    box.lo[a] = std::max(0, box.lo[a] - margin);
    box.hi[a] = std::min(frame.size[a], box.hi[a] + margin);
  }
  return box;
}

Around around(const Volume& volume, const LabelVolume& labels, const Component& part) {
  const VoxelBox box = looked_at(part, labels.frame);
  const Mask outside =
      mask_over(labels, box, [&](std::size_t n) { return labels.values[n] != part.label; });
  const Grid<float> away_m = distance_map(outside);
  const auto to_m = static_cast<float>(farthest_looked_m(labels.frame));
  std::size_t air = 0, tissue = 0, n = 0;
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int j = box.lo[1]; j < box.hi[1]; ++j)
      for (int i = box.lo[0]; i < box.hi[0]; ++i, ++n) {
        const float d_m = away_m.values[n];
        if (d_m <= static_cast<float>(kFrom_m) || d_m > to_m || labels.at(i, j, k) != 0) continue;
        ++(volume.at(i, j, k) < kAirBelow_hu ? air : tissue);
      }
  if (air + tissue == 0) return Around::kNothing;
  return air > tissue ? Around::kAir : Around::kTissue;
}

}  // namespace

std::vector<bool> parts_outside_body(const Volume& volume, const LabelVolume& labels,
                                     std::span<const Component> parts) {
  std::vector<bool> outside;
  bool body = false;
  for (const Component& part : parts) {
    const Around seen = around(volume, labels, part);
    body = body || seen == Around::kTissue;
    outside.push_back(seen == Around::kAir);
  }
  if (!body) outside.assign(parts.size(), false);
  return outside;
}

}  // namespace osteon
