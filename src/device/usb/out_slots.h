#pragma once

#include <algorithm>
#include <array>

#include "usb_transport.h"

namespace osteon {

/// Values that wait for the OUT endpoint: the newest of each slot. Slots take turns. Its own
/// memory.
class OutSlots {
 public:
  void put(std::size_t slot, std::span<const std::uint8_t> bytes) {
    Slot& s = slots_[slot];
    if (s.waiting) ++replaced_;
    s.size = std::min(bytes.size(), s.bytes.size());
    std::copy_n(bytes.begin(), s.size, s.bytes.begin());
    s.waiting = true;
  }

  /// The next slot in turn that waits, now taken out; kSlots when none does.
  std::size_t take() {
    for (std::size_t i = 1; i <= slots_.size(); ++i) {
      const std::size_t slot = (last_ + i) % slots_.size();
      if (!slots_[slot].waiting) continue;
      slots_[slot].waiting = false;
      last_ = slot;
      return slot;
    }
    return slots_.size();
  }

  /// Gives back a value that was taken but did not leave, unless a newer one waits.
  void give_back(std::size_t slot) {
    if (slots_[slot].waiting)
      ++replaced_;
    else
      slots_[slot].waiting = true;
  }

  std::span<const std::uint8_t> bytes(std::size_t slot) const {
    return {slots_[slot].bytes.data(), slots_[slot].size};
  }
  bool waits(std::size_t slot) const { return slots_[slot].waiting; }
  bool any() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const Slot& s) { return s.waiting; });
  }
  void clear() {
    for (Slot& s : slots_) s.waiting = false;
  }
  std::uint64_t replaced() const { return replaced_; }
  void count_replaced() { ++replaced_; }

 private:
  struct Slot {
    std::array<std::uint8_t, UsbLink::kPacketBytes> bytes{};
    std::size_t size = 0;
    bool waiting = false;
  };
  std::array<Slot, UsbLink::kSlots> slots_{};
  std::size_t last_ = UsbLink::kSlots - 1;
  std::uint64_t replaced_ = 0;
};

}  // namespace osteon
