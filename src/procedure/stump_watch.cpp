#include "osteon/procedure/stump_watch.h"

#include <cmath>

namespace osteon {

// Less than was told: a restore point has brought it back.
void StumpWatch::add(std::uint64_t tick, const BoneSnapshot& bones, std::vector<Event>& out) {
  felt_ = bones.cleared_percent >= 0;
  if (!felt_) return;
  const int now = static_cast<int>(std::floor(bones.cleared_percent));
  const bool again = now > 0 && tick % kTellStumps == 0;
  if (now == told_percent_ && !again) return;
  told_percent_ = now;
  Event event;
  event.tick = tick;
  event.kind = kStumpsCleared;
  event.hand = 0;
  event.values = {static_cast<double>(now), 0, 0};
  out.push_back(event);
}

}  // namespace osteon
