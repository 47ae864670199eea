#pragma once

#include <algorithm>
#include <array>

#include "usb_transport.h"

namespace osteon {

/// The last packets that came in, in order; when full the oldest gives way. Its own memory.
class PacketRing {
 public:
  void push(std::span<const std::uint8_t> bytes, std::int64_t time_ns) {
    if (count_ == slots_.size()) {
      first_ = (first_ + 1) % slots_.size();
      --count_;
      ++dropped_;
    }
    Slot& slot = slots_[(first_ + count_) % slots_.size()];
    slot.size = std::min(bytes.size(), slot.bytes.size());
    std::copy_n(bytes.begin(), slot.size, slot.bytes.begin());
    slot.time_ns = time_ns;
    ++count_;
  }

  bool pop(UsbPacket& packet) {
    if (count_ == 0) return false;
    const Slot& slot = slots_[first_];
    packet = {{slot.bytes.data(), slot.size}, slot.time_ns};
    first_ = (first_ + 1) % slots_.size();
    --count_;
    return true;
  }

  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Slot {
    std::array<std::uint8_t, UsbLink::kPacketBytes> bytes{};
    std::size_t size = 0;
    std::int64_t time_ns = 0;
  };
  // One more than promised: the packet last popped stays whole until the next push or two.
  std::array<Slot, UsbLink::kQueuedPackets + 1> slots_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace osteon
