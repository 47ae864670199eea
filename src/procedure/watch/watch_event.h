#pragma once

#include <array>
#include <cstdint>

#include "osteon/scene/event.h"

namespace osteon {

/// An event of what several hands do together: it counts as the first one's.
inline Event event_of(std::uint64_t tick, EventKind kind, const std::array<double, 3>& values) {
  Event event;
  event.tick = tick;
  event.kind = kind;
  event.hand = 0;
  event.values = values;
  return event;
}

}  // namespace osteon
