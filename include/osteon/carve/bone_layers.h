#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"

namespace osteon {

/// What a bone consists of.
enum class BoneTissue : std::uint8_t { kCortical, kCancellous, kMarrow, kCartilage };
inline constexpr std::size_t kBoneTissues = 4;
/// As in the tissue table: "cortical_bone", "cancellous_bone", "marrow", "cartilage".
std::string_view to_text(BoneTissue tissue);

/// A number for each tissue, e.g. a volume.
using ByTissue = std::array<double, kBoneTissues>;

/// From this depth under the bone's surface on, down to the next layer.
struct BoneLayer {
  double depth_m = 0;
  BoneTissue tissue = BoneTissue::kCortical;
};

/// Tissue by depth: all that is known of a bare mesh. The default is the one by which the virtual
/// scanner looks at bones: a cortical shell of 1.2 mm around cancellous bone.
struct BoneLayers {
  std::vector<BoneLayer> layers{{0, BoneTissue::kCortical}, {0.0012, BoneTissue::kCancellous}};
  BoneTissue at(double depth_m) const;
};

/// The most layers of a bone.
inline constexpr std::size_t kMostBoneLayers = 4;
/// A cortex of that thickness, and marrow from a depth on where that is positive. Fails on a number
/// that is not finite, a negative cortex, or marrow above the cortex' end.
Result<BoneLayers> bone_layers(double cortex_m, double marrow_m = 0);
/// Fails unless there are 1 to 4 layers, the first at depth 0, by rising depth.
Result<void> check(const BoneLayers& layers);

}  // namespace osteon
