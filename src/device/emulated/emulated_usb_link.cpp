#include "emulated_usb_link.h"

#include <algorithm>
#include <cmath>

namespace osteon {

EmulatedUsbLink::EmulatedUsbLink(EmulatedUsbBus& bus, EmulatedUsbBus::Port& port,
                                 const UsbChannel& channel)
    : bus_(bus), port_(port), channel_(channel) {
  channel_.in_bytes = std::clamp<std::size_t>(channel_.in_bytes, 1, kPacketBytes);
  port_.link = this;
}

EmulatedUsbLink::~EmulatedUsbLink() {
  if (port_.link == this) port_.link = nullptr;
}

void EmulatedUsbLink::poll() {
  // As on the real bus: a value that the device has not taken in time gives way to a newer one.
  const double age_s = static_cast<double>(bus_.now_ns() - out_since_ns_) * 1e-9;
  if (!out_in_flight_ || !slots_.waits(out_slot_) || age_s < channel_.replace_after_s) return;
  out_in_flight_ = false;
  slots_.count_replaced();
  send_next();
}

bool EmulatedUsbLink::write(std::size_t slot, std::span<const std::uint8_t> bytes) {
  if (gone_ || out_error_ != UsbError::kNone || slot >= kSlots) return false;
  slots_.put(slot, bytes);
  send_next();
  return true;
}

void EmulatedUsbLink::send_next() {
  if (out_in_flight_ || gone_ || out_error_ != UsbError::kNone) return;
  const std::size_t slot = slots_.take();
  if (slot == kSlots) return;
  const auto bytes = slots_.bytes(slot);
  std::copy(bytes.begin(), bytes.end(), out_bytes_.begin());
  out_size_ = bytes.size();
  out_slot_ = slot;
  out_since_ns_ = bus_.now_ns();
  out_in_flight_ = true;
}

bool EmulatedUsbLink::start_control(const UsbSetup& setup, std::span<const std::uint8_t> out,
                                    double timeout_s) {
  if (control_running_ || gone_ || setup.length > kControlBytes) return false;
  if (!setup.is_in() && out.size() < setup.length) return false;
  setup_ = setup;
  control_size_ = 0;
  if (!setup.is_in()) {
    std::copy_n(out.begin(), setup.length, control_bytes_.begin());
    control_size_ = setup.length;
  }
  control_deadline_ns_ = bus_.now_ns() + std::llround(std::max(0.001, timeout_s) * 1e9);
  control_error_ = UsbError::kNone;
  control_running_ = true;
  return true;
}

UsbControlResult EmulatedUsbLink::control() const {
  const std::size_t size = setup_.is_in() && !control_running_ ? control_size_ : 0;
  return {control_running_, control_error_, {control_bytes_.data(), size}};
}

void EmulatedUsbLink::wait(double limit_s) {
  const std::uint64_t before = ended_;
  const std::int64_t end_ns = bus_.now_ns() + std::llround(std::max(0.0, limit_s) * 1e9);
  while (ended_ == before && bus_.now_ns() < end_ns) {
    bus_.advance(EmulatedUsbBus::kMicroframe_ns);
    poll();
  }
}

void EmulatedUsbLink::restart() {
  if (gone_) return;
  if (in_error_ != UsbError::kNone) port_.faults.stall_in = false;
  if (out_error_ != UsbError::kNone) port_.faults.stall_out = false;
  in_error_ = out_error_ = UsbError::kNone;
  out_in_flight_ = false;
  slots_.clear();
}

UsbCounters EmulatedUsbLink::counters() const {
  UsbCounters c = counters_;
  c.in_dropped = ring_.dropped();
  c.replaced = slots_.replaced();
  return c;
}

void EmulatedUsbLink::unplug() {
  gone_ = true;
  out_in_flight_ = false;
  slots_.clear();
  late_count_ = 0;
  if (control_running_) control_error_ = UsbError::kGone;
  control_running_ = false;
  ++ended_;
}

void EmulatedUsbLink::run_control(EmulatedUsbDevice& device, const UsbFaults& faults, bool silent) {
  if (!control_running_) return;
  if (silent) {
    if (bus_.now_ns() < control_deadline_ns_) return;
    control_error_ = UsbError::kTimeout;
  } else if (faults.stall_control) {
    control_error_ = UsbError::kStall;
  } else {
    const std::span<std::uint8_t> room(control_bytes_.data(), setup_.length);
    std::size_t size = 0;
    const bool ok = setup_.is_in() ? device.control(setup_, {}, room, size)
                                   : device.control(setup_, room, {}, size);
    control_error_ = ok ? UsbError::kNone : UsbError::kStall;
    if (setup_.is_in()) control_size_ = ok ? std::min(size, room.size()) : 0;
  }
  control_running_ = false;
  ++ended_;
}

void EmulatedUsbLink::frame_out(EmulatedUsbDevice& device, UsbFaults& faults) {
  const bool silent = bus_.now_ns() < faults.silent_until_ns;
  run_control(device, faults, silent);
  if (!out_in_flight_ || silent) return;
  out_in_flight_ = false;
  ++ended_;
  if (faults.stall_out) {
    out_error_ = UsbError::kStall;
    return;
  }
  std::size_t size = out_size_;
  if (faults.short_out > 0) {
    --faults.short_out;
    size /= 2;
    out_error_ = UsbError::kShort;
  }
  device.take_out(channel_.out_endpoint, {out_bytes_.data(), size});
  if (size == out_size_) ++counters_.out;
  send_next();
}

void EmulatedUsbLink::frame_in(EmulatedUsbDevice& device, EmulatedUsbBus::Port& port) {
  UsbFaults& faults = port.faults;
  deliver_late();
  if (in_error_ != UsbError::kNone || bus_.now_ns() < faults.silent_until_ns) return;
  if (faults.stall_in) {
    in_error_ = UsbError::kStall;
    ++ended_;
    return;
  }
  std::array<std::uint8_t, kPacketBytes> packet;
  std::size_t size = device.give_in(channel_.in_endpoint, packet);
  if (size == 0) return;
  if (size > channel_.in_bytes) {
    in_error_ = UsbError::kOverflow;
    ++ended_;
    return;
  }
  if (faults.garbage_in > 0) {
    --faults.garbage_in;
    for (std::size_t i = 0; i < size; ++i)
      packet[i] = static_cast<std::uint8_t>(port.random.next() >> 56);
  }
  if (faults.short_in > 0) {
    --faults.short_in;
    size /= 2;
  }
  receive({packet.data(), size}, bus_.now_ns() + faults.in_late_ns);
}

void EmulatedUsbLink::receive(std::span<const std::uint8_t> bytes, std::int64_t due_ns) {
  if (late_count_ == late_.size()) return;  // as a host without buffers: the packet is lost
  Late& late = late_[(late_first_ + late_count_++) % late_.size()];
  std::copy(bytes.begin(), bytes.end(), late.bytes.begin());
  late.size = bytes.size();
  late.due_ns = due_ns;
  deliver_late();
}

void EmulatedUsbLink::deliver_late() {
  while (late_count_ > 0 && late_[late_first_].due_ns <= bus_.now_ns()) {
    const Late& late = late_[late_first_];
    ring_.push({late.bytes.data(), late.size}, bus_.now_ns());
    late_first_ = (late_first_ + 1) % late_.size();
    --late_count_;
    ++counters_.in;
    ++ended_;
  }
}

}  // namespace osteon
