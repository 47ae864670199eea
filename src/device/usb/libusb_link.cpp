#include "libusb_link.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libusb_handles.h"
#include "osteon/base/clock.h"
#include "out_slots.h"
#include "packet_ring.h"

namespace osteon {
namespace {

constexpr double kCloseLimit_s = 0.5;

UsbError to_error(libusb_transfer_status status) {
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

UsbError to_error(int code) {
  if (code == 0) return UsbError::kNone;
  return code == LIBUSB_ERROR_NO_DEVICE ? UsbError::kGone : UsbError::kOther;
}

timeval to_timeval(double s) {
  const double whole = std::floor(std::max(0.0, s));
  return {static_cast<time_t>(whole), static_cast<suseconds_t>((std::max(0.0, s) - whole) * 1e6)};
}

/// A transfer with its buffer.
template <std::size_t kBytes>
struct Pipe {
  Pipe() : transfer(libusb_alloc_transfer(0)) {}
  ~Pipe() { libusb_free_transfer(transfer); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  libusb_transfer* transfer;
  std::array<std::uint8_t, kBytes> buffer{};
  bool in_flight = false;
};

}  // namespace

// The state that libusb's callbacks write to. It outlives the link if transfers refuse to end.
struct LibusbIo {
  std::array<Pipe<UsbLink::kPacketBytes>, 2> in;
  Pipe<UsbLink::kPacketBytes> out;
  Pipe<UsbLink::kControlBytes + LIBUSB_CONTROL_SETUP_SIZE> control;
  PacketRing ring;
  OutSlots slots;
  std::size_t out_slot = 0;
  std::int64_t out_since_ns = 0;
  bool out_cancelled = false;
  UsbError control_error = UsbError::kNone;
  std::size_t control_bytes = 0;
  UsbError in_error = UsbError::kNone;
  UsbError out_error = UsbError::kNone;
  UsbCounters counters;
  int ended = 0;  // set by every callback: libusb's `completed`
  bool gone = false;
  bool closing = false;

  bool busy() const {
    return in[0].in_flight || in[1].in_flight || out.in_flight || control.in_flight;
  }
};

namespace {

void note_gone(LibusbIo& io, UsbError error) {
  if (error == UsbError::kGone) io.gone = true;
}

template <class P>
UsbError submit(LibusbIo& io, P& pipe) {
  const UsbError error = to_error(libusb_submit_transfer(pipe.transfer));
  pipe.in_flight = error == UsbError::kNone;
  note_gone(io, error);
  return error;
}

void LIBUSB_CALL on_in(libusb_transfer* transfer) {
  LibusbIo& io = *static_cast<LibusbIo*>(transfer->user_data);
  auto& pipe = transfer == io.in[0].transfer ? io.in[0] : io.in[1];
  pipe.in_flight = false;
  io.ended = 1;
  const UsbError error = to_error(transfer->status);
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

void send_next(LibusbIo& io) {
  if (io.out.in_flight || io.gone || io.closing || io.out_error != UsbError::kNone) return;
  const std::size_t slot = io.slots.take();
  if (slot == UsbLink::kSlots) return;
  const auto bytes = io.slots.bytes(slot);
  std::copy(bytes.begin(), bytes.end(), io.out.buffer.begin());
  io.out.transfer->length = static_cast<int>(bytes.size());
  io.out_slot = slot;
  io.out_since_ns = steady_now_ns();
  io.out_cancelled = false;
  io.out_error = submit(io, io.out);
}

void LIBUSB_CALL on_out(libusb_transfer* transfer) {
  LibusbIo& io = *static_cast<LibusbIo*>(transfer->user_data);
  io.out.in_flight = false;
  io.ended = 1;
  if (transfer->status == LIBUSB_TRANSFER_CANCELLED) {
    io.slots.give_back(io.out_slot);
  } else {
    io.out_error = to_error(transfer->status);
    note_gone(io, io.out_error);
    if (io.out_error == UsbError::kNone && transfer->actual_length < transfer->length)
      io.out_error = UsbError::kShort;
    if (io.out_error == UsbError::kNone) ++io.counters.out;
  }
  send_next(io);
}

void LIBUSB_CALL on_control(libusb_transfer* transfer) {
  LibusbIo& io = *static_cast<LibusbIo*>(transfer->user_data);
  io.control.in_flight = false;
  io.ended = 1;
  io.control_error = to_error(transfer->status);
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

class LibusbLink : public UsbLink {
 public:
  LibusbLink(LibusbContext context, LibusbHandle handle, const UsbChannel& channel)
      : context_(std::move(context)),
        handle_(std::move(handle)),
        channel_(channel),
        io_(std::make_unique<LibusbIo>()) {}

  ~LibusbLink() override {
    io_->closing = true;
    cancel_all();
    const std::int64_t end_ns = steady_now_ns() + static_cast<std::int64_t>(kCloseLimit_s * 1e9);
    while (io_->busy() && steady_now_ns() < end_ns) wait(0.01);
    libusb_release_interface(handle_.get(), channel_.interface_number);
    // A transfer that will not end still owns its memory: better lost than freed under it.
    if (io_->busy()) (void)io_.release();
  }

  // Fills the transfers and starts reading. `in_type`, `out_type`: as the descriptors say.
  void start(unsigned char in_type, unsigned char out_type) {
    for (auto& pipe : io_->in) {
      fill(pipe.transfer, channel_.in_endpoint, in_type, pipe.buffer.data(), &on_in);
      pipe.transfer->length = static_cast<int>(channel_.in_bytes);
    }
    fill(io_->out.transfer, channel_.out_endpoint, out_type, io_->out.buffer.data(), &on_out);
    start_reading();
  }

  std::int64_t now_ns() const override { return steady_now_ns(); }

  void poll() override {
    timeval now{0, 0};
    libusb_handle_events_timeout_completed(context_.get(), &now, nullptr);
    cancel_old_out();
  }

  bool next_in(UsbPacket& packet) override { return io_->ring.pop(packet); }

  bool write(std::size_t slot, std::span<const std::uint8_t> bytes) override {
    if (io_->gone || io_->out_error != UsbError::kNone || slot >= kSlots) return false;
    io_->slots.put(slot, bytes);
    send_next(*io_);
    return io_->out_error == UsbError::kNone;
  }

  bool out_idle() const override { return !io_->out.in_flight && !io_->slots.any(); }

  bool start_control(const UsbSetup& setup, std::span<const std::uint8_t> out,
                     double timeout_s) override {
    auto& pipe = io_->control;
    if (pipe.in_flight || io_->gone || setup.length > kControlBytes) return false;
    if (!setup.is_in() && out.size() < setup.length) return false;
    libusb_fill_control_setup(pipe.buffer.data(), setup.request_type, setup.request, setup.value,
                              setup.index, setup.length);
    if (!setup.is_in())
      std::copy_n(out.begin(), setup.length, pipe.buffer.begin() + LIBUSB_CONTROL_SETUP_SIZE);
    libusb_fill_control_transfer(
        pipe.transfer, handle_.get(), pipe.buffer.data(), &on_control, io_.get(),
        static_cast<unsigned>(std::ceil(std::max(0.001, timeout_s) * 1e3)));
    io_->control_bytes = 0;
    io_->control_error = submit(*io_, pipe);
    return pipe.in_flight;
  }

  UsbControlResult control() const override {
    const auto* data = io_->control.buffer.data() + LIBUSB_CONTROL_SETUP_SIZE;
    return {io_->control.in_flight, io_->control_error, {data, io_->control_bytes}};
  }

  void wait(double limit_s) override {
    timeval limit = to_timeval(limit_s);
    io_->ended = 0;
    libusb_handle_events_timeout_completed(context_.get(), &limit, &io_->ended);
    if (!io_->closing) cancel_old_out();
  }

  void restart() override {
    if (io_->gone) return;
    if (io_->in_error != UsbError::kNone) libusb_clear_halt(handle_.get(), channel_.in_endpoint);
    if (io_->out_error != UsbError::kNone) libusb_clear_halt(handle_.get(), channel_.out_endpoint);
    io_->in_error = io_->out_error = UsbError::kNone;
    io_->slots.clear();
    start_reading();
  }

  bool gone() const override { return io_->gone; }
  UsbError in_error() const override { return io_->in_error; }
  UsbError out_error() const override { return io_->out_error; }
  UsbCounters counters() const override {
    UsbCounters c = io_->counters;
    c.in_dropped = io_->ring.dropped();
    c.replaced = io_->slots.replaced();
    return c;
  }

 private:
  void fill(libusb_transfer* t, std::uint8_t endpoint, unsigned char type, std::uint8_t* buffer,
            libusb_transfer_cb_fn callback) {
    t->dev_handle = handle_.get();
    t->endpoint = endpoint;
    t->type = type;
    t->timeout = 0;
    t->buffer = buffer;
    t->user_data = io_.get();
    t->callback = callback;
  }

  void start_reading() {
    for (auto& pipe : io_->in)
      if (!pipe.in_flight && io_->in_error == UsbError::kNone) io_->in_error = submit(*io_, pipe);
  }

  // A stalled device must not get an old force first when it wakes.
  void cancel_old_out() {
    if (!io_->out.in_flight || io_->out_cancelled || !io_->slots.waits(io_->out_slot)) return;
    const double age_s = static_cast<double>(steady_now_ns() - io_->out_since_ns) * 1e-9;
    if (age_s < channel_.replace_after_s) return;
    io_->out_cancelled = libusb_cancel_transfer(io_->out.transfer) == 0;
  }

  void cancel_all() {
    for (auto& pipe : io_->in)
      if (pipe.in_flight) libusb_cancel_transfer(pipe.transfer);
    if (io_->out.in_flight) libusb_cancel_transfer(io_->out.transfer);
    if (io_->control.in_flight) libusb_cancel_transfer(io_->control.transfer);
  }

  // In this order: the transfers go before the handle, the handle before its context.
  LibusbContext context_;
  LibusbHandle handle_;
  UsbChannel channel_;
  std::unique_ptr<LibusbIo> io_;
};

tl::unexpected<Error> open_failed(int code, const UsbEntry& entry) {
  const std::string where = usb_id(entry.vendor, entry.product) + " at " + entry.port;
  if (code == LIBUSB_ERROR_ACCESS)
    return fail("no permission to open the USB device", where,
                "Run 'osteon doctor' to install the udev rule, then plug it in again");
  if (code == LIBUSB_ERROR_BUSY)
    return fail("another program holds the USB device", where, "Close that program");
  return fail(std::string("the USB device cannot be opened: ") +
                  libusb_strerror(static_cast<libusb_error>(code)),
              where, "Plug it in again");
}

LibusbHandle open_handle(libusb_context* context, const UsbEntry& entry, int& code) {
  code = LIBUSB_ERROR_NO_DEVICE;
  for (libusb_device* device : LibusbDeviceList(context)) {
    libusb_device_descriptor d{};
    if (libusb_get_device_descriptor(device, &d) != 0) continue;
    if (d.idVendor != entry.vendor || d.idProduct != entry.product) continue;
    if (port_name(device) != entry.port) continue;
    libusb_device_handle* handle = nullptr;
    code = libusb_open(device, &handle);
    return LibusbHandle(code == 0 ? handle : nullptr);
  }
  return {};
}

// Transfer type of an endpoint of the interface; -1 when it has none of that address.
int endpoint_type(libusb_device_handle* handle, std::uint8_t interface_number,
                  std::uint8_t endpoint) {
  libusb_config_descriptor* config = nullptr;
  if (libusb_get_active_config_descriptor(libusb_get_device(handle), &config) != 0) return -1;
  int type = -1;
  for (int i = 0; i < config->bNumInterfaces; ++i) {
    const libusb_interface& itf = config->interface[i];
    if (itf.num_altsetting < 1 || itf.altsetting[0].bInterfaceNumber != interface_number) continue;
    for (int e = 0; e < itf.altsetting[0].bNumEndpoints; ++e)
      if (itf.altsetting[0].endpoint[e].bEndpointAddress == endpoint)
        type = itf.altsetting[0].endpoint[e].bmAttributes & LIBUSB_TRANSFER_TYPE_MASK;
  }
  libusb_free_config_descriptor(config);
  return type;
}

bool is_packet_pipe(int type) {
  return type == LIBUSB_TRANSFER_TYPE_BULK || type == LIBUSB_TRANSFER_TYPE_INTERRUPT;
}

}  // namespace

Result<std::unique_ptr<UsbLink>> open_libusb_link(const UsbEntry& entry,
                                                  const UsbChannel& channel) {
  int code = 0;
  LibusbContext context = make_libusb_context(code);
  if (!context) return open_failed(code, entry);
  LibusbHandle handle = open_handle(context.get(), entry, code);
  if (!handle) return open_failed(code, entry);
  const int in_type = endpoint_type(handle.get(), channel.interface_number, channel.in_endpoint);
  const int out_type = endpoint_type(handle.get(), channel.interface_number, channel.out_endpoint);
  if (!is_packet_pipe(in_type) || !is_packet_pipe(out_type))
    return fail("the USB device lacks the endpoints that its profile names",
                usb_id(entry.vendor, entry.product) + " at " + entry.port,
                "Correct the profile in assets/devices");
  libusb_set_auto_detach_kernel_driver(handle.get(), 1);
  code = libusb_claim_interface(handle.get(), channel.interface_number);
  if (code != 0) return open_failed(code, entry);
  UsbChannel fitted = channel;
  fitted.in_bytes = std::clamp<std::size_t>(fitted.in_bytes, 1, UsbLink::kPacketBytes);
  auto link = std::make_unique<LibusbLink>(std::move(context), std::move(handle), fitted);
  link->start(static_cast<unsigned char>(in_type), static_cast<unsigned char>(out_type));
  return link;
}

}  // namespace osteon
