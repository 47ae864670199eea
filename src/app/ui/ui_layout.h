#pragma once

namespace osteon {

struct UiRect {
  float x = 0, y = 0, w = 0, h = 0;
  float right() const { return x + w; }
  float bottom() const { return y + h; }
};

/// Where the parts of the window lie, pixels from its top left. The picture fills everything
/// between the top bar and the timeline; the cards float on its left and right edge and are at most
/// as tall as `left` and `right`.
struct UiLayout {
  UiRect top, left, right, bottom, picture;
};

/// The left card's width in units, when it is dragged.
inline constexpr float kLeastLeftCard = 136, kMostLeftCard = 360;
/// While an exercise runs its card is at the top of the left side, which is at least so wide; the
/// left card has the room below it, at least so much.
inline constexpr float kExerciseCard = 264, kLeastCaseCard = 96;

/// On an 8-pixel grid times `scale`. Folded: the picture is the whole window. `left_card`: width of
/// the left card in units; 0: wide enough for most names where the window has room. It is never
/// wider than a third of the window.
UiLayout make_layout(float width, float height, float scale, bool panels_open, float left_card = 0);

}  // namespace osteon
