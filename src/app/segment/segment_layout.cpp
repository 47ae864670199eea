#include <algorithm>
#include <cmath>

#include "segment/segment_model.h"

namespace osteon {
namespace {

constexpr float kUnit = 8;
constexpr float kTopBar = 5 * kUnit;
constexpr float kToolCard = 26 * kUnit;
constexpr float kBoneCard = 28 * kUnit;
constexpr float kPaneGap = 2;

}  // namespace

SegmentLayout make_segment_layout(float width, float height, float scale, bool panels_open) {
  const auto px = [scale](float units) { return std::round(units * scale); };
  SegmentLayout out;
  out.middle = {0, 0, width, height};
  if (panels_open) {
    out.top = {0, 0, width, px(kTopBar)};
    const float below = std::max(1.0f, height - out.top.h);
    out.tools = {0, out.top.h, px(kToolCard), below};
    out.bones = {width - px(kBoneCard), out.top.h, px(kBoneCard), below};
    out.middle = {out.tools.right(), out.top.h, std::max(1.0f, out.bones.x - out.tools.right()),
                  below};
  }
  const float gap = std::max(1.0f, px(kPaneGap));
  const float w = std::max(1.0f, std::floor((out.middle.w - gap) / 2));
  const float h = std::max(1.0f, std::floor((out.middle.h - gap) / 2));
  const float x2 = out.middle.x + w + gap, y2 = out.middle.y + h + gap;
  const float w2 = std::max(1.0f, out.middle.right() - x2);
  const float h2 = std::max(1.0f, out.middle.bottom() - y2);
  out.slices[0] = {out.middle.x, out.middle.y, w, h};
  out.solid = {x2, out.middle.y, w2, h};
  out.slices[1] = {out.middle.x, y2, w, h2};
  out.slices[2] = {x2, y2, w2, h2};
  return out;
}

}  // namespace osteon
