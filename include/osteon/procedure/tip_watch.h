#pragma once

#include <cstdint>
#include <vector>

#include "osteon/scene/event.h"
#include "osteon/scene/state.h"

namespace osteon {

/// Where the tip of a hand's tool is, of the hand itself: the event's place. The session makes none
/// of them.
inline constexpr EventKind kTipAt{407};

/// Adds such an event 100 times a second. A function of the tool's state: a replay makes the same
/// ones. A pose that is not finite makes none.
void tell_tip(const ToolState& tool, std::uint8_t hand, double tick_s, std::vector<Event>& out);

}  // namespace osteon
