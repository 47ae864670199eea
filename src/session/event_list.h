#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "osteon/scene/event.h"

namespace osteon {

/// Events of one tick, in a place of fixed size. No tick has so many; if one had, the last are
/// dropped.
class EventList {
 public:
  static constexpr std::size_t kMost = 32;
  void clear() { count_ = 0; }
  void add(const Event& event) {
    if (count_ < kMost) events_[count_++] = event;
  }
  std::span<const Event> all() const { return {events_.data(), count_}; }

 private:
  std::array<Event, kMost> events_{};
  std::size_t count_ = 0;
};

}  // namespace osteon
