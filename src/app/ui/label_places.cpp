#include "ui/label_places.h"

#include <algorithm>
#include <utility>

namespace osteon {
namespace {

constexpr float kMostHeights = 10;

bool covers(const UiRect& a, const UiRect& b, float gap) {
  return a.x < b.right() + gap && b.x < a.right() + gap && a.y < b.bottom() + gap &&
         b.y < a.bottom() + gap;
}

const UiRect* in_the_way(std::span<const UiRect> placed, const UiRect& r, float gap) {
  const auto found = std::find_if(placed.begin(), placed.end(),
                                  [&](const UiRect& other) { return covers(other, r, gap); });
  return found == placed.end() ? nullptr : &*found;
}

// Moves a label past what covers it, up or down, until nothing does. Each step passes one of the
// placed, and rounding may ask for one of them twice: after so many steps it stays.
UiRect moved_clear(std::span<const UiRect> placed, UiRect r, float gap, bool up) {
  constexpr float kBeyond = 0.01f;  // more than rounding
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const UiRect* other = in_the_way(placed, r, gap);
    if (!other) break;
    r.y = up ? other->y - gap - r.h - kBeyond : other->bottom() + gap + kBeyond;
  }
  return r;
}

}  // namespace

std::vector<UiRect> spread_labels(std::span<const UiRect> wanted, float gap,
                                  std::vector<UiRect> taken) {
  std::vector<UiRect> placed = std::move(taken);
  const auto before = static_cast<std::ptrdiff_t>(placed.size());
  for (const UiRect& r : wanted) {
    const UiRect up = moved_clear(placed, r, gap, true);
    const UiRect down = moved_clear(placed, r, gap, false);
    const UiRect& nearest = r.y - up.y < down.y - r.y ? up : down;
    const float moved = nearest.y < r.y ? r.y - nearest.y : nearest.y - r.y;
    placed.push_back(moved > kMostHeights * r.h ? r : nearest);
  }
  return {placed.begin() + before, placed.end()};
}

}  // namespace osteon
