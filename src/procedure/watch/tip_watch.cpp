#include "osteon/procedure/tip_watch.h"

#include <algorithm>
#include <cmath>

namespace osteon {

void tell_tip(const ToolState& tool, std::uint8_t hand, double tick_s, std::vector<Event>& out) {
  constexpr double kTipHz = 100;
  const auto stride = static_cast<std::uint64_t>(std::max(1.0, std::round(1 / (kTipHz * tick_s))));
  if (tool.tick % stride != 0 || !is_finite(tool.X_WP)) return;
  Event made;
  made.tick = tool.tick;
  made.kind = kTipAt;
  made.hand = hand;
  made.p_W = tool.X_WP.p;
  out.push_back(made);
}

}  // namespace osteon
