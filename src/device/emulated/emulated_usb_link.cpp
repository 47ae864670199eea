#include "emulated_usb_link.h"

#include <algorithm>
#include <cmath>

namespace osteon {

EmulatedUsbLink::EmulatedUsbLink(EmulatedUsbBus& bus, EmulatedUsbBus::Port& port,
                                 const UsbChannel& channel)
    : bus_(bus), port_(port), channel_(channel) {
  channel_.in_bytes = std::clamp<std::size_t>(channel_.in_bytes, 1, kPacketBytes);
  out_by_control_ = !port.device->has_out_endpoint(channel.out_endpoint);
  out_room_ = port.device->speed() == UsbSpeed::kHigh && !out_by_control_ ? kMostInFlight : 1;
  port_.link = this;
}

EmulatedUsbLink::~EmulatedUsbLink() {
  if (port_.link == this) port_.link = nullptr;
}

void EmulatedUsbLink::poll() { drop_old_out(); }

// As on the real bus: a value that the device has not taken in time gives way to a newer one.
void EmulatedUsbLink::drop_old_out() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < out_count_; ++i) {
    const double age_s = static_cast<double>(bus_.now_ns() - out_[i].since_ns) * 1e-9;
    const bool old = slots_.waits(out_[i].slot) && age_s >= channel_.replace_after_s;
    if (old)
      slots_.give_back(out_[i].slot);
    else if (kept++ != i)
      out_[kept - 1] = out_[i];
  }
  out_count_ = kept;
}

void EmulatedUsbLink::put(std::size_t slot, std::span<const std::uint8_t> bytes, double level) {
  if (!gone_ && out_error_ == UsbError::kNone && slot < kSlots) slots_.put(slot, bytes, level);
}

bool EmulatedUsbLink::send() {
  if (gone_ || out_error_ != UsbError::kNone) return false;
  while (out_count_ < out_room_) {
    const std::size_t slot = slots_.take();
    if (slot == kSlots) break;
    Out& out = out_[out_count_++];
    const auto bytes = slots_.bytes(slot);
    std::copy(bytes.begin(), bytes.end(), out.bytes.begin());
    out.size = bytes.size();
    out.slot = slot;
    out.since_ns = bus_.now_ns();
  }
  return true;
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
  send();
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
  out_count_ = 0;
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
  out_count_ = 0;
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
  // There is one control endpoint: what is set up goes first.
  const bool control_taken = control_running_ && out_by_control_;
  run_control(device, faults, silent);
  if (out_count_ > 0 && !silent && !control_taken) run_out(device, faults);
}

// The oldest packet in flight.
void EmulatedUsbLink::run_out(EmulatedUsbDevice& device, UsbFaults& faults) {
  const Out out = out_[0];
  std::copy(out_.begin() + 1, out_.begin() + static_cast<std::ptrdiff_t>(out_count_), out_.begin());
  --out_count_;
  slots_.done(out.slot);
  ++ended_;
  if (faults.stall_out || (faults.stall_control && out_by_control_)) {
    out_error_ = UsbError::kStall;
    return;
  }
  std::size_t size = out.size;
  if (faults.short_out > 0) {
    --faults.short_out;
    size /= 2;
  }
  if (!hand_over(device, {out.bytes.data(), size})) out_error_ = UsbError::kStall;
  if (size != out.size) out_error_ = UsbError::kShort;
  if (out_error_ == UsbError::kNone) ++counters_.out;
}

// False: the device answers STALL.
bool EmulatedUsbLink::hand_over(EmulatedUsbDevice& device, std::span<const std::uint8_t> bytes) {
  if (!out_by_control_) {
    device.take_out(channel_.out_endpoint, bytes);
    return true;
  }
  const std::uint8_t id = bytes.empty() ? std::uint8_t{0} : bytes.front();
  std::size_t none = 0;
  return device.control(set_output_report(channel_.interface_number, id, bytes.size()), bytes, {},
                        none);
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
