#pragma once

#include "emulated_usb.h"
#include "usb/out_slots.h"
#include "usb/packet_ring.h"

namespace osteon {

class EmulatedUsbLink;

/// One device on the emulated bus with its faults. Unplugged it lives on: it has power of its own.
struct EmulatedUsbBus::Port {
  std::string name;
  std::shared_ptr<EmulatedUsbDevice> device;
  UsbFaults faults;
  bool plugged = true;
  bool forbidden = false;
  EmulatedUsbLink* link = nullptr;  ///< the one that has it open
  Random random{1};
};

/// The host's side of one open device on the emulated bus.
class EmulatedUsbLink : public UsbLink {
 public:
  EmulatedUsbLink(EmulatedUsbBus& bus, EmulatedUsbBus::Port& port, const UsbChannel& channel);
  ~EmulatedUsbLink() override;

  std::int64_t now_ns() const override { return bus_.now_ns(); }
  void poll() override;
  bool next_in(UsbPacket& packet) override { return ring_.pop(packet); }
  void put(std::size_t slot, std::span<const std::uint8_t> bytes, double level) override;
  bool send() override;
  bool out_idle() const override { return out_count_ == 0 && !slots_.any(); }
  bool start_control(const UsbSetup& setup, std::span<const std::uint8_t> out,
                     double timeout_s) override;
  UsbControlResult control() const override;
  void wait(double limit_s) override;
  void restart() override;
  bool gone() const override { return gone_; }
  UsbError in_error() const override { return in_error_; }
  UsbError out_error() const override { return out_error_; }
  UsbCounters counters() const override;

  /// The bus's side: one frame's transactions, before and after the device's own step.
  void frame_out(EmulatedUsbDevice& device, UsbFaults& faults);
  void frame_in(EmulatedUsbDevice& device, EmulatedUsbBus::Port& port);
  void unplug();

 private:
  struct Late {
    std::array<std::uint8_t, kPacketBytes> bytes{};
    std::size_t size = 0;
    std::int64_t due_ns = 0;
  };
  // An OUT packet in the host's hands.
  struct Out {
    std::array<std::uint8_t, kPacketBytes> bytes{};
    std::size_t size = 0;
    std::size_t slot = 0;
    std::int64_t since_ns = 0;
  };
  void drop_old_out();
  void run_out(EmulatedUsbDevice& device, UsbFaults& faults);
  bool hand_over(EmulatedUsbDevice& device, std::span<const std::uint8_t> bytes);
  void run_control(EmulatedUsbDevice& device, const UsbFaults& faults, bool silent);
  void receive(std::span<const std::uint8_t> bytes, std::int64_t due_ns);
  void deliver_late();

  EmulatedUsbBus& bus_;
  EmulatedUsbBus::Port& port_;
  UsbChannel channel_;
  PacketRing ring_;
  OutSlots slots_;
  std::array<Out, kMostInFlight> out_;  ///< in flight, oldest first
  std::size_t out_count_ = 0;
  std::size_t out_room_ = 1;
  bool out_by_control_ = false;

  UsbSetup setup_;
  std::array<std::uint8_t, kControlBytes> control_bytes_{};
  std::size_t control_size_ = 0;
  std::int64_t control_deadline_ns_ = 0;
  bool control_running_ = false;
  UsbError control_error_ = UsbError::kNone;

  std::array<Late, 256> late_;
  std::size_t late_first_ = 0;
  std::size_t late_count_ = 0;

  UsbError in_error_ = UsbError::kNone;
  UsbError out_error_ = UsbError::kNone;
  UsbCounters counters_;
  std::uint64_t ended_ = 0;  ///< counts what ended, for `wait`
  bool gone_ = false;
};

}  // namespace osteon
