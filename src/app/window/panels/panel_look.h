#pragma once

#include <string>

#include "osteon/render/renderer.h"
#include "window/panels/panels.h"

namespace osteon {

/// The little square in a row's colour; pressed, it opens the popup of that name.
void draw_swatch(const PanelContext& c, const BoneAppearance& look, const char* popup,
                 const char* explanation);

/// Name, colour and opacity, within an open popup. True when the user changed something.
bool edit_look(const std::string& label, BoneAppearance& look);

}  // namespace osteon
