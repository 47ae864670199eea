#include "osteon/carve/bone_layers.h"

#include <algorithm>
#include <cmath>

namespace osteon {

std::string_view to_text(BoneTissue tissue) {
  constexpr std::array<std::string_view, kBoneTissues> kNames{"cortical_bone", "cancellous_bone",
                                                              "marrow", "cartilage"};
  return kNames[static_cast<std::size_t>(tissue)];
}

BoneTissue BoneLayers::at(double depth_m) const {
  BoneTissue found = layers.front().tissue;
  for (const BoneLayer& layer : layers)
    if (depth_m >= layer.depth_m) found = layer.tissue;
  return found;
}

Result<BoneLayers> bone_layers(double cortex_m, double marrow_m) {
  constexpr double kDeepest_m = 0.03;
  const auto sound = [](double x) { return std::isfinite(x) && x >= 0 && x <= kDeepest_m; };
  if (!sound(cortex_m) || !sound(marrow_m))
    return fail("a layer's depth must be 0 to 30 mm", "layers of bone");
  if (marrow_m > 0 && marrow_m < cortex_m)
    return fail("the marrow begins within the cortex", "layers of bone",
                "Give a depth of the marrow beyond the cortex, or a thinner cortex");
  BoneLayers made;
  made.layers.clear();
  if (cortex_m > 0) made.layers.push_back({0, BoneTissue::kCortical});
  if (marrow_m <= 0 || marrow_m > cortex_m)
    made.layers.push_back({cortex_m, BoneTissue::kCancellous});
  if (marrow_m > 0) made.layers.push_back({marrow_m, BoneTissue::kMarrow});
  return made;
}

Result<void> check(const BoneLayers& layers) {
  const auto& list = layers.layers;
  if (list.empty() || list.size() > kMostBoneLayers || list.front().depth_m != 0)
    return fail("a bone has 1 to 4 layers, the first at depth 0", "layers of bone");
  const auto lower = [](const BoneLayer& a, const BoneLayer& b) {
    return !(a.depth_m < b.depth_m);
  };
  if (std::adjacent_find(list.begin(), list.end(), lower) != list.end())
    return fail("layers must be in order of depth", "layers of bone");
  return {};
}

}  // namespace osteon
