#include "ui/ui_layout.h"

#include <algorithm>
#include <cmath>

namespace osteon {
namespace {
constexpr float kGrid = 8;
constexpr float kTop = 5 * kGrid;
constexpr float kBottom = 6.5f * kGrid;
constexpr float kRight = 25 * kGrid;
constexpr float kMargin = kGrid;
// The left card that nobody has dragged: a share of the window.
constexpr float kLeftShare = 0.134375f, kLeftSmall = 19 * kGrid, kLeftLarge = kRight;
}  // namespace

UiLayout make_layout(float width, float height, float scale, bool panels_open, float left_card) {
  UiLayout layout;
  if (!panels_open) {
    layout.picture = {0, 0, width, height};
    return layout;
  }
  const auto px = [scale](float units) { return std::round(units * scale); };
  layout.top = {0, 0, width, px(kTop)};
  layout.bottom = {0, height - px(kBottom), width, px(kBottom)};
  layout.picture = {0, layout.top.h, width,
                    std::max(1.0f, height - layout.top.h - layout.bottom.h)};
  const float card_y = layout.picture.y + px(kMargin);
  const float card_h = std::max(1.0f, layout.picture.h - 2 * px(kMargin));
  const float left = left_card > 0 ? std::clamp(left_card, kLeastLeftCard, kMostLeftCard)
                                   : std::clamp(kLeftShare * width / scale, kLeftSmall, kLeftLarge);
  layout.left = {px(kMargin), card_y, std::min(px(left), std::round(width / 3)), card_h};
  layout.right = {width - px(kRight) - px(kMargin), card_y, px(kRight), card_h};
  return layout;
}

}  // namespace osteon
