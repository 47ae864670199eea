#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "usb_transport.h"

namespace osteon {

/// Values that wait for the OUT endpoint: the newest of each slot. What is farthest from the last
/// that left goes first. Its own memory.
class OutSlots {
 public:
  void put(std::size_t slot, std::span<const std::uint8_t> bytes, double level) {
    Slot& s = slots_[slot];
    if (s.waiting) ++replaced_;
    s.size = std::min(bytes.size(), s.bytes.size());
    std::copy_n(bytes.begin(), s.size, s.bytes.begin());
    s.level = level;
    s.waiting = true;
  }

  /// The slot to send next, now in flight; kSlots when none waits. One that is in flight is not
  /// sent beside itself. Of equals the next in turn.
  std::size_t take() {
    std::size_t best = slots_.size();
    for (std::size_t i = 1; i <= slots_.size(); ++i) {
      const std::size_t slot = (last_ + i) % slots_.size();
      const Slot& s = slots_[slot];
      if (!s.waiting || s.in_flight) continue;
      if (best == slots_.size() || s.urgency() > slots_[best].urgency()) best = slot;
    }
    if (best == slots_.size()) return best;
    for (Slot& s : slots_)
      if (s.waiting) ++s.passed_over;
    Slot& s = slots_[best];
    s.waiting = false;
    s.in_flight = true;
    s.before = s.sent;
    s.sent = s.level;
    s.passed_over = 0;
    last_ = best;
    return best;
  }

  /// What was taken has left, or has failed.
  void done(std::size_t slot) { slots_[slot].in_flight = false; }
  /// What was taken did not leave: it waits again, unless a newer one does.
  void give_back(std::size_t slot) {
    Slot& s = slots_[slot];
    s.in_flight = false;
    s.sent = s.before;
    if (s.waiting)
      ++replaced_;
    else
      s.waiting = true;
  }

  std::span<const std::uint8_t> bytes(std::size_t slot) const {
    return {slots_[slot].bytes.data(), slots_[slot].size};
  }
  bool waits(std::size_t slot) const { return slots_[slot].waiting; }
  bool any() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const Slot& s) { return s.waiting; });
  }
  void clear() {
    for (Slot& s : slots_) s.waiting = s.in_flight = false;
  }
  std::uint64_t replaced() const { return replaced_; }

 private:
  struct Slot {
    std::array<std::uint8_t, UsbLink::kPacketBytes> bytes{};
    std::size_t size = 0;
    double level = 0;   ///< of the value
    double sent = 0;    ///< level of the last that was taken
    double before = 0;  ///< of the one before it
    int passed_over = 0;
    bool waiting = false;
    bool in_flight = false;
    // Nobody waits for ever: a value that changes nothing is told again after some turns, in case
    // the device has lost it.
    double urgency() const {
      constexpr int kLongest = 12;
      return passed_over >= kLongest ? HUGE_VAL : std::abs(level - sent) * (1 + passed_over);
    }
  };
  std::array<Slot, UsbLink::kSlots> slots_{};
  std::size_t last_ = UsbLink::kSlots - 1;
  std::uint64_t replaced_ = 0;
};

}  // namespace osteon
