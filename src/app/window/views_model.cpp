#include "window/views_model.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace osteon {
namespace {

constexpr float kPaneGap = 8;
constexpr float kLargeShare = 0.68f;  // of the space, at most, for the large pane of several

struct LayoutName {
  PictureLayout layout;
  const char *name, *title;
};
constexpr std::array<LayoutName, kPictureLayouts> kNames = {{
    {PictureLayout::kOutside, "outside", "Outside"},
    {PictureLayout::kScope, "scope", "Scope"},
    {PictureLayout::kPanorama, "panorama", "Panorama"},
    {PictureLayout::kAll, "layout", "All"},
    {PictureLayout::kFluoro, "fluoro", "X-ray"},
}};

PaneKind only_pane(PictureLayout layout) {
  switch (layout) {
    case PictureLayout::kScope:
    case PictureLayout::kAll:
      return PaneKind::kScope;
    case PictureLayout::kPanorama:
      return PaneKind::kPanorama;
    case PictureLayout::kFluoro:
      return PaneKind::kFluoro;
    case PictureLayout::kOutside:
      break;
  }
  return PaneKind::kOutside;
}

/// Panes of one size in a column, or in a row where it is `across`.
void put_in_line(const std::vector<PaneKind>& kinds, const UiRect& free, float gap, bool across,
                 std::vector<Pane>& panes) {
  const auto count = static_cast<float>(kinds.size());
  const float length = across ? free.w : free.h;
  const float each = std::floor((length - gap * (count - 1)) / count);
  float at = 0;
  for (const PaneKind kind : kinds) {
    const UiRect area = across ? UiRect{free.x + at, free.y, each, free.h}
                               : UiRect{free.x, free.y + at, free.w, each};
    panes.push_back({kind, area, false});
    at += each + gap;
  }
}

}  // namespace

Result<PictureLayout> parse_picture_layout(const std::string& text) {
  for (const LayoutName& known : kNames)
    if (text == known.name) return known.layout;
  return fail("\"" + text + "\" is not a layout of the window", "--layout",
              "Choose outside, scope, panorama, layout or fluoro");
}

const char* title_of(PictureLayout layout) {
  return kNames[static_cast<std::size_t>(layout) % kPictureLayouts].title;
}

PictureLayout next_layout(PictureLayout layout) {
  return kNames[(static_cast<std::size_t>(layout) + 1) % kPictureLayouts].layout;
}

const char* title_of(PaneKind kind) {
  static constexpr std::array<const char*, 4> kTitles = {"Outside", "Scope", "Panorama", "X-ray"};
  return kTitles[static_cast<std::size_t>(kind) % kTitles.size()];
}

// The scope's picture is round, so the large pane is as square as the space allows; the others
// stand beside it, or under it where the space is tall.
std::vector<Pane> panes_of(PictureLayout layout, const UiRect& free, float scale, bool has_shot) {
  if (layout != PictureLayout::kAll) return {{only_pane(layout), free, true}};
  const float gap = std::round(kPaneGap * scale);
  const bool across = free.w < 1.15f * free.h;
  const float longer = across ? free.h : free.w, shorter = across ? free.w : free.h;
  const float large = std::floor(std::min(shorter, kLargeShare * longer));
  UiRect main = free, rest = free;
  (across ? main.h : main.w) = large;
  (across ? rest.y : rest.x) += large + gap;
  (across ? rest.h : rest.w) = std::max(1.0f, longer - large - gap);
  std::vector<PaneKind> small = {PaneKind::kPanorama, PaneKind::kOutside};
  if (has_shot) small.push_back(PaneKind::kFluoro);
  std::vector<Pane> panes = {{PaneKind::kScope, main, true}};
  put_in_line(small, rest, gap, across, panes);
  return panes;
}

}  // namespace osteon
