#pragma once

#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/render/renderer.h"

namespace osteon {

struct PictureSize {
  int width = 1280, height = 720;
};

/// "1280x720"; each side 1 to kMaxImageSide.
Result<PictureSize> parse_picture_size(const std::string& text);

/// "dorsal", "palmar", "radial", "ulnar", "ap" or "lateral"; the first four are a knee's "front",
/// "back", "outer" and "inner".
Result<ViewPreset> parse_view_preset(const std::string& text);

/// Makes the named bones ("scaphoid,lunate") invisible. Fails with the name that the case lacks.
Result<void> hide_bones(const Case& the_case, const std::vector<std::string>& names,
                        ViewState& view);

/// Shows soft parts: "all", "none", or names of parts or kinds ("ligament,tfcc_disc"). Fails with
/// the word that the case knows neither as a part nor as a kind.
Result<void> show_softs(const Case& the_case, const std::vector<std::string>& names,
                        ViewState& view);

}  // namespace osteon
