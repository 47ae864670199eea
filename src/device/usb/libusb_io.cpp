#include "libusb_io.h"

#include <algorithm>
#include <cmath>

#include "osteon/base/clock.h"

namespace osteon {
namespace {

void note_gone(LibusbIo& io, UsbError error) {
  if (error == UsbError::kGone) io.gone = true;
}

template <class P>
UsbError submit(LibusbIo& io, P& pipe) {
  const UsbError error = to_usb_error(libusb_submit_transfer(pipe.transfer));
  pipe.in_flight = error == UsbError::kNone;
  note_gone(io, error);
  return error;
}

void LIBUSB_CALL on_in(libusb_transfer* transfer) {
  LibusbIo& io = *static_cast<LibusbIo*>(transfer->user_data);
  auto& pipe = transfer == io.in[0].transfer ? io.in[0] : io.in[1];
  pipe.in_flight = false;
  io.ended = 1;
  const UsbError error = to_usb_error(transfer->status);
  note_gone(io, error);
  if (transfer->status == LIBUSB_TRANSFER_COMPLETED) {
    ++io.counters.in;
    io.ring.push({pipe.buffer.data(), static_cast<std::size_t>(transfer->actual_length)},
                 steady_now_ns());
  } else if (io.in_error == UsbError::kNone) {
    io.in_error = error;
  }
  if (!io.closing && !io.gone && io.in_error == UsbError::kNone) io.in_error = submit(io, pipe);
}

void LIBUSB_CALL on_out(libusb_transfer* transfer) {
  LibusbIo& io = *static_cast<LibusbIo*>(transfer->user_data);
  const auto pipe = std::find_if(io.out.begin(), io.out.end(),
                                 [&](const LibusbOutPipe& p) { return p.transfer == transfer; });
  pipe->in_flight = false;
  io.ended = 1;
  if (transfer->status == LIBUSB_TRANSFER_CANCELLED) return io.slots.give_back(pipe->slot);
  io.slots.done(pipe->slot);
  UsbError error = to_usb_error(transfer->status);
  note_gone(io, error);
  // libusb counts the bytes of a control transfer without its set-up.
  const int head = io.out_by_control ? static_cast<int>(LIBUSB_CONTROL_SETUP_SIZE) : 0;
  if (error == UsbError::kNone && transfer->actual_length < transfer->length - head)
    error = UsbError::kShort;
  if (error == UsbError::kNone)
    ++io.counters.out;
  else if (io.out_error == UsbError::kNone)
    io.out_error = error;
}

void LIBUSB_CALL on_control(libusb_transfer* transfer) {
  LibusbIo& io = *static_cast<LibusbIo*>(transfer->user_data);
  io.control.in_flight = false;
  io.ended = 1;
  io.control_error = to_usb_error(transfer->status);
  if (transfer->status == LIBUSB_TRANSFER_CANCELLED) io.control_error = UsbError::kTimeout;
  note_gone(io, io.control_error);
  const int wanted = transfer->length - static_cast<int>(LIBUSB_CONTROL_SETUP_SIZE);
  const bool is_in = (io.control.buffer[0] & 0x80) != 0;
  if (io.control_error == UsbError::kNone && !is_in && transfer->actual_length < wanted)
    io.control_error = UsbError::kShort;
  io.control_bytes = is_in && io.control_error == UsbError::kNone
                         ? static_cast<std::size_t>(transfer->actual_length)
                         : 0;
}

void fill(LibusbIo& io, libusb_transfer* t, std::uint8_t endpoint, unsigned char type,
          std::uint8_t* buffer, libusb_transfer_cb_fn callback) {
  t->dev_handle = io.handle;
  t->endpoint = endpoint;
  t->type = type;
  t->timeout = 0;
  t->buffer = buffer;
  t->user_data = &io;
  t->callback = callback;
}

void fill_setup(std::uint8_t* buffer, const UsbSetup& s) {
  libusb_fill_control_setup(buffer, s.request_type, s.request, s.value, s.index, s.length);
}

// Copies the value of a slot into the transfer.
void load(LibusbIo& io, LibusbOutPipe& pipe) {
  const auto bytes = io.slots.bytes(pipe.slot);
  std::size_t head = 0;
  if (io.out_by_control) {
    head = LIBUSB_CONTROL_SETUP_SIZE;
    const std::uint8_t id = bytes.empty() ? std::uint8_t{0} : bytes.front();
    fill_setup(pipe.buffer.data(),
               set_output_report(io.channel.interface_number, id, bytes.size()));
  }
  std::copy(bytes.begin(), bytes.end(), pipe.buffer.begin() + static_cast<std::ptrdiff_t>(head));
  pipe.transfer->length = static_cast<int>(head + bytes.size());
}

}  // namespace

UsbError to_usb_error(libusb_transfer_status status) {
  switch (status) {
    case LIBUSB_TRANSFER_COMPLETED:
    case LIBUSB_TRANSFER_CANCELLED:
      return UsbError::kNone;
    case LIBUSB_TRANSFER_STALL:
      return UsbError::kStall;
    case LIBUSB_TRANSFER_TIMED_OUT:
      return UsbError::kTimeout;
    case LIBUSB_TRANSFER_NO_DEVICE:
      return UsbError::kGone;
    case LIBUSB_TRANSFER_OVERFLOW:
      return UsbError::kOverflow;
    case LIBUSB_TRANSFER_ERROR:
      break;
  }
  return UsbError::kOther;
}

UsbError to_usb_error(int code) {
  if (code == 0) return UsbError::kNone;
  return code == LIBUSB_ERROR_NO_DEVICE ? UsbError::kGone : UsbError::kOther;
}

bool LibusbIo::out_busy() const {
  return std::any_of(out.begin(), out.end(), [](const LibusbOutPipe& p) { return p.in_flight; });
}

bool LibusbIo::busy() const {
  return in[0].in_flight || in[1].in_flight || out_busy() || control.in_flight;
}

void LibusbIo::prepare(unsigned char in_type, unsigned char out_type) {
  for (auto& pipe : in) {
    fill(*this, pipe.transfer, channel.in_endpoint, in_type, pipe.buffer.data(), &on_in);
    pipe.transfer->length = static_cast<int>(channel.in_bytes);
  }
  const std::uint8_t endpoint = out_by_control ? std::uint8_t{0} : channel.out_endpoint;
  for (auto& pipe : out)
    fill(*this, pipe.transfer, endpoint, out_type, pipe.buffer.data(), &on_out);
}

void LibusbIo::start_reading() {
  for (auto& pipe : in)
    if (!pipe.in_flight && in_error == UsbError::kNone) in_error = submit(*this, pipe);
}

void LibusbIo::send() {
  for (std::size_t i = 0; i < out_pipes; ++i) {
    LibusbOutPipe& pipe = out[i];
    if (gone || closing || out_error != UsbError::kNone) return;
    if (pipe.in_flight) continue;
    pipe.slot = slots.take();
    if (pipe.slot == UsbLink::kSlots) return;
    load(*this, pipe);
    pipe.since_ns = steady_now_ns();
    pipe.cancelled = false;
    out_error = submit(*this, pipe);
    if (out_error != UsbError::kNone) slots.done(pipe.slot);
  }
}

void LibusbIo::cancel_old_out() {
  for (LibusbOutPipe& pipe : out) {
    if (!pipe.in_flight || pipe.cancelled || !slots.waits(pipe.slot)) continue;
    const double age_s = static_cast<double>(steady_now_ns() - pipe.since_ns) * 1e-9;
    if (age_s >= channel.replace_after_s)
      pipe.cancelled = libusb_cancel_transfer(pipe.transfer) == 0;
  }
}

bool LibusbIo::start_control(const UsbSetup& setup, std::span<const std::uint8_t> bytes,
                             double timeout_s) {
  if (control.in_flight || gone || setup.length > UsbLink::kControlBytes) return false;
  if (!setup.is_in() && bytes.size() < setup.length) return false;
  fill_setup(control.buffer.data(), setup);
  if (!setup.is_in())
    std::copy_n(bytes.begin(), setup.length, control.buffer.begin() + LIBUSB_CONTROL_SETUP_SIZE);
  libusb_fill_control_transfer(control.transfer, handle, control.buffer.data(), &on_control, this,
                               static_cast<unsigned>(std::ceil(std::max(0.001, timeout_s) * 1e3)));
  control_bytes = 0;
  control_error = submit(*this, control);
  return control.in_flight;
}

void LibusbIo::cancel_all() {
  for (auto& pipe : in)
    if (pipe.in_flight) libusb_cancel_transfer(pipe.transfer);
  for (auto& pipe : out)
    if (pipe.in_flight) libusb_cancel_transfer(pipe.transfer);
  if (control.in_flight) libusb_cancel_transfer(control.transfer);
}

}  // namespace osteon
