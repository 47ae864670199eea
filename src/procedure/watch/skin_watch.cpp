#include "osteon/procedure/skin_watch.h"

#include <algorithm>
#include <utility>

namespace osteon {

void SkinWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                    std::vector<Event>& out) {
  const SkinOpening& skin = bones.softs.skin;
  for (std::size_t h = 0; h < std::min(tools.size(), strokes_.size()); ++h) {
    const SkinBlade& now = skin.blades[h];
    SkinBlade& worst = strokes_[h];
    if (now.in) {
      worst = {true, std::max(worst.aside_m, now.aside_m), std::max(worst.past_m, now.past_m)};
      continue;
    }
    const SkinBlade done = std::exchange(worst, {});
    if (!done.in) continue;
    Event event;
    event.tick = tools[h]->tick;
    event.kind = kSkinOpened;
    event.hand = static_cast<std::uint8_t>(h);
    event.p_W = tools[h]->X_WP.p;
    event.values = {1e3 * skin.open_m, 1e3 * done.aside_m, 1e3 * done.past_m};
    out.push_back(event);
  }
}

}  // namespace osteon
