#include "libusb_link.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libusb_handles.h"
#include "libusb_io.h"
#include "osteon/base/clock.h"

namespace osteon {
namespace {

constexpr double kCloseLimit_s = 0.5;

timeval to_timeval(double s) {
  const double whole = std::floor(std::max(0.0, s));
  return {static_cast<time_t>(whole), static_cast<suseconds_t>((std::max(0.0, s) - whole) * 1e6)};
}

class LibusbLink : public UsbLink {
 public:
  LibusbLink(LibusbContext context, LibusbHandle handle, std::unique_ptr<LibusbIo> io)
      : context_(std::move(context)), handle_(std::move(handle)), io_(std::move(io)) {
    io_->start_reading();
  }

  ~LibusbLink() override {
    io_->closing = true;
    io_->cancel_all();
    const std::int64_t end_ns = steady_now_ns() + static_cast<std::int64_t>(kCloseLimit_s * 1e9);
    while (io_->busy() && steady_now_ns() < end_ns) wait(0.01);
    libusb_release_interface(handle_.get(), io_->channel.interface_number);
    // A transfer that will not end still owns its memory: better lost than freed under it.
    if (io_->busy()) (void)io_.release();
  }

  std::int64_t now_ns() const override { return steady_now_ns(); }

  void poll() override {
    timeval now{0, 0};
    libusb_handle_events_timeout_completed(context_.get(), &now, nullptr);
    io_->cancel_old_out();
  }

  bool next_in(UsbPacket& packet) override { return io_->ring.pop(packet); }

  void put(std::size_t slot, std::span<const std::uint8_t> bytes, double level) override {
    if (!io_->gone && io_->out_error == UsbError::kNone && slot < kSlots)
      io_->slots.put(slot, bytes, level);
  }
  bool send() override {
    io_->send();
    return !io_->gone && io_->out_error == UsbError::kNone;
  }
  bool out_idle() const override { return !io_->out_busy() && !io_->slots.any(); }

  bool start_control(const UsbSetup& setup, std::span<const std::uint8_t> out,
                     double timeout_s) override {
    return io_->start_control(setup, out, timeout_s);
  }
  UsbControlResult control() const override {
    const auto* data = io_->control.buffer.data() + LIBUSB_CONTROL_SETUP_SIZE;
    return {io_->control.in_flight, io_->control_error, {data, io_->control_bytes}};
  }

  void wait(double limit_s) override {
    timeval limit = to_timeval(limit_s);
    io_->send();
    io_->ended = 0;
    libusb_handle_events_timeout_completed(context_.get(), &limit, &io_->ended);
    if (!io_->closing) io_->cancel_old_out();
  }

  void restart() override {
    if (io_->gone) return;
    if (io_->in_error != UsbError::kNone)
      libusb_clear_halt(handle_.get(), io_->channel.in_endpoint);
    // The control endpoint clears its STALL with the next set-up.
    if (io_->out_error != UsbError::kNone && !io_->out_by_control)
      libusb_clear_halt(handle_.get(), io_->channel.out_endpoint);
    io_->in_error = io_->out_error = UsbError::kNone;
    io_->slots.clear();
    io_->start_reading();
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
  // In this order: the transfers go before the handle, the handle before its context.
  LibusbContext context_;
  LibusbHandle handle_;
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

// Its endpoints and its speed; null when it lacks what the channel names.
std::unique_ptr<LibusbIo> io_for(libusb_device_handle* handle, const UsbChannel& channel) {
  const int in_type = endpoint_type(handle, channel.interface_number, channel.in_endpoint);
  int out_type = endpoint_type(handle, channel.interface_number, channel.out_endpoint);
  auto io = std::make_unique<LibusbIo>();
  io->out_by_control = channel.reports_by_control && out_type < 0;
  if (io->out_by_control) out_type = LIBUSB_TRANSFER_TYPE_CONTROL;
  if (!is_packet_pipe(in_type) || !(is_packet_pipe(out_type) || io->out_by_control)) return nullptr;
  io->handle = handle;
  io->channel = channel;
  io->channel.in_bytes = std::clamp<std::size_t>(channel.in_bytes, 1, UsbLink::kPacketBytes);
  // At full speed a frame has room for one: what waits may still be replaced by something newer.
  const bool fast = libusb_get_device_speed(libusb_get_device(handle)) >= LIBUSB_SPEED_HIGH;
  io->out_pipes = fast && !io->out_by_control ? UsbLink::kMostInFlight : 1;
  io->prepare(static_cast<unsigned char>(in_type), static_cast<unsigned char>(out_type));
  return io;
}

}  // namespace

Result<std::unique_ptr<UsbLink>> open_libusb_link(const UsbEntry& entry,
                                                  const UsbChannel& channel) {
  int code = 0;
  LibusbContext context = make_libusb_context(code);
  if (!context) return open_failed(code, entry);
  LibusbHandle handle = open_handle(context.get(), entry, code);
  if (!handle) return open_failed(code, entry);
  auto io = io_for(handle.get(), channel);
  if (!io)
    return fail("the USB device lacks the endpoints that its profile names",
                usb_id(entry.vendor, entry.product) + " at " + entry.port,
                "Correct the profile in assets/devices");
  libusb_set_auto_detach_kernel_driver(handle.get(), 1);
  code = libusb_claim_interface(handle.get(), channel.interface_number);
  if (code != 0) return open_failed(code, entry);
  return std::make_unique<LibusbLink>(std::move(context), std::move(handle), std::move(io));
}

}  // namespace osteon
