#include "bone/overlap.h"

#include <vector>

#include "bone/surface_gaps.h"

namespace osteon {

Overlap deepest_overlap(const GeneratedAnatomy& anatomy, const PlacedBones& placed,
                        const GenerateOptions& options) {
  std::vector<const MeshDistance*> surfaces_W;
  for (std::size_t i = 0; i < placed.size(); ++i) surfaces_W.push_back(&placed.surface_W(i));
  Overlap deepest;
  for (const BoneGap& gap : surface_gaps(surfaces_W, 0, options))
    if (-gap.gap_m > deepest.depth)
      deepest = {anatomy.bones[gap.first].name, anatomy.bones[gap.second].name, -gap.gap_m};
  return deepest;
}

}  // namespace osteon
