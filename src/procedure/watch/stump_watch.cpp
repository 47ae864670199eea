#include "osteon/procedure/stump_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "watch/tip_sight.h"
#include "watch/watch_event.h"

namespace osteon {

StumpWatch::StumpWatch(const Case& the_case, std::vector<std::optional<ScopeOptics>> optics)
    : case_(&the_case), optics_(std::move(optics)) {}

// What clears is in the joint; of several instruments there it is enough to see one.
std::optional<bool> StumpWatch::is_tip_watched(std::span<const ToolState* const> tools,
                                               const BoneSnapshot& bones) const {
  std::optional<bool> watched;
  for (std::size_t h = 0; h < tools.size(); ++h) {
    const bool scope = h < optics_.size() && optics_[h];
    if (scope || tools[h]->portal == kNoPortal || !is_finite(tools[h]->X_WP)) continue;
    watched = watched.value_or(false) || is_tip_seen(*case_, optics_, tools, h, bones);
  }
  return watched;
}

// Less than was known: a restore point has brought it back.
void StumpWatch::add(std::span<const ToolState* const> tools, const BoneSnapshot& bones,
                     bool obscured, std::vector<Event>& out) {
  felt_ = bones.softs.cleared_percent >= 0;
  if (!felt_ || tools.empty()) return;
  const double now_percent = bones.softs.cleared_percent;
  const double more = now_percent - std::exchange(cleared_percent_, now_percent);
  if (more > 0 && (obscured || !is_tip_watched(tools, bones).value_or(false)))
    blind_percent_ += more;
  blind_percent_ = std::min(blind_percent_, cleared_percent_);
  const int now = static_cast<int>(std::floor(cleared_percent_));
  const std::uint64_t tick = tools[0]->tick;
  const bool again = now > 0 && tick % kTellStumps == 0;
  if (now == told_percent_ && !again) return;
  told_percent_ = now;
  out.push_back(event_of(tick, kStumpsCleared, {static_cast<double>(now), blind_percent_, 0}));
}

}  // namespace osteon
