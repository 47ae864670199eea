#include "window/xray_model.h"

#include <algorithm>
#include <cmath>

namespace osteon {

// The picture is square.
XrayPlaces xray_places(const UiRect& pane, float scale) {
  constexpr float kDeskWidth = 176, kDeskHeight = 132, kGap = 8;
  constexpr float kWithStrip = 520, kStripHeight = 100;
  const float gap = std::round(kGap * scale);
  const bool narrow = pane.w < kWithStrip * scale;
  const float w = std::min(std::round(kDeskWidth * scale), pane.w / 2);
  const float h =
      std::min(std::round((kDeskHeight + (narrow ? kStripHeight : 0)) * scale), pane.h / 2);
  const float beside = std::min(pane.w - w - gap, pane.h);
  const float under = std::min(pane.w, pane.h - h - gap);
  XrayPlaces places{pane, pane, beside >= under};
  if (places.beside) {
    places.picture.w = std::max(1.0f, pane.w - w - gap);
    places.desk = {pane.right() - w, pane.y, w, pane.h};
  } else {
    places.strip_below = narrow;
    places.picture.h = std::max(1.0f, pane.h - h - gap);
    places.desk = {pane.x, pane.bottom() - h, pane.w, h};
  }
  return places;
}

}  // namespace osteon
