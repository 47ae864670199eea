#include "osteon/render/renderer.h"

namespace osteon {

ViewState default_view(const Case& the_case) {
  ViewState view;
  view.camera = preset_camera(ViewPreset::kDorsal, the_case, 16.0 / 9.0);
  for (std::size_t k = 0; k < the_case.bones.size(); ++k) {
    // Steps of a golden ratio spread the tones evenly, so that neighbours differ a little.
    const double step = 0.618034 * static_cast<double>(k);
    const auto tone = static_cast<float>(step - static_cast<double>(static_cast<int>(step)) - 0.5);
    BoneAppearance look;
    look.color[0] += 0.035f * tone;
    look.color[1] += 0.045f * tone;
    look.color[2] += 0.075f * tone;
    view.bones.push_back(look);
  }
  constexpr float kSkinOpacity = 0.28f;
  for (const SoftPart& soft : the_case.softs) {
    BoneAppearance look;
    look.color = soft.color_srgb;
    // What is felt is seen: the cartilage of a bone that is felt with it.
    look.visible = soft.kind == "cartilage" && soft.bones.size() == 1 &&
                   the_case.bones[soft.bones.front().index].covered != nullptr;
    if (soft.kind == "skin") look.opacity = kSkinOpacity;
    view.softs.push_back(look);
  }
  return view;
}

}  // namespace osteon
