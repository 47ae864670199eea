#pragma once

#include <string>
#include <vector>

#include "window/panels/panels.h"

namespace osteon {

/// Words over the picture, and where their ground lies, pixels.
struct PictureWords {
  std::string text;
  UiRect at;
};

/// Of the notes that are drawn, in their order: beside their dots, none over another. What would
/// lie under a card has no text; on the side of its dot where a card begins, the other side is
/// taken.
std::vector<PictureWords> note_words(const PanelContext& c);
/// The distance at the tip's line. Only where that is drawn.
PictureWords tip_words(const PanelContext& c);
/// Of each of the hands' names, in their order; they keep off notes and the tip's distance. One
/// that would lie under a card has no text.
std::vector<PictureWords> name_words(const PanelContext& c);

}  // namespace osteon
