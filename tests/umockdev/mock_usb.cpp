#include "umockdev/mock_usb.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>

namespace osteon::testing {
namespace {

usbdevfs_urb& urb_of(UMockdevIoctlData* data) {
  return *reinterpret_cast<usbdevfs_urb*>(data->data);
}

bool is_in(const usbdevfs_urb& urb) { return (urb.endpoint & 0x80) != 0; }

std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  char two[3];
  for (const std::uint8_t byte : bytes) {
    std::snprintf(two, sizeof two, "%02x", byte);
    text += two;
  }
  return text;
}

}  // namespace

MockUsb::MockUsb(UMockdevTestbed* testbed, std::shared_ptr<EmulatedUsbDevice> device,
                 const JoystickDescriptors& descriptors, int number, Clock clock)
    : testbed_(testbed),
      handler_(umockdev_ioctl_base_new()),
      device_(std::move(device)),
      descriptors_hex_(hex(descriptors.device) + hex(descriptors.configuration)),
      number_(number),
      clock_(clock),
      start_us_(g_get_monotonic_time()) {
  g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(&MockUsb::on_ioctl), this);
}

MockUsb::~MockUsb() {
  for (const Urb& urb : flying_) umockdev_ioctl_data_unref(urb.data);
  for (const Urb& urb : done_) umockdev_ioctl_data_unref(urb.data);
  g_signal_handlers_disconnect_by_data(handler_, this);
  g_object_unref(handler_);
}

std::string MockUsb::sys_path() const { return "/devices/usb1/1-" + std::to_string(number_); }

void MockUsb::plug(bool with_node) {
  char node[32], number[8];
  std::snprintf(node, sizeof node, "bus/usb/001/%03d", number_);
  std::snprintf(number, sizeof number, "%03d", number_);
  locked([&] { gone_ = false; });
  if (with_node && !attached_)
    umockdev_testbed_attach_ioctl(testbed_, (std::string("/dev/") + node).c_str(), handler_,
                                  nullptr);
  attached_ = attached_ || with_node;
  const std::string n = std::to_string(number_);
  const std::string text =
      "P: " + sys_path() + "\n" + (with_node ? std::string("N: ") + node + "\n" : "") +
      "E: SUBSYSTEM=usb\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=" + number + "\nE: DEVNAME=/dev/" +
      node + "\nE: DEVTYPE=usb_device\nE: MAJOR=189\nE: MINOR=" + n +
      "\nA: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=" + n +
      "\\n\nA: speed=" + (device_->speed() == UsbSpeed::kHigh ? "480" : "12") +
      "\\n\nH: descriptors=" + descriptors_hex_ + "\n";
  GError* error = nullptr;
  umockdev_testbed_add_from_string(testbed_, text.c_str(), &error);
  if (error) g_error("umockdev: %s", error->message);
}

void MockUsb::unplug() {
  locked([&] {
    gone_ = true;
    while (!flying_.empty()) {
      end(flying_.front(), -ENODEV);
      flying_.pop_front();
    }
    device_->disconnected();
  });
  umockdev_testbed_uevent(testbed_, ("/sys" + sys_path()).c_str(), "remove");
  umockdev_testbed_remove_device(testbed_, ("/sys" + sys_path()).c_str());
}

gboolean MockUsb::on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  auto& mock = *static_cast<MockUsb*>(self);
  const std::lock_guard<std::mutex> lock(mock.mutex_);
  return mock.handle(client) ? TRUE : FALSE;
}

bool MockUsb::handle(UMockdevIoctlClient* client) {
  UMockdevIoctlData* arg = umockdev_ioctl_client_get_arg(client);
  pump();
  switch (umockdev_ioctl_client_get_request(client)) {
    case USBDEVFS_GET_CAPABILITIES: {
      UMockdevIoctlData* data = umockdev_ioctl_data_resolve(arg, 0, sizeof(guint32), nullptr);
      *reinterpret_cast<guint32*>(data->data) =
          USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      umockdev_ioctl_client_complete(client, 0, 0);
      umockdev_ioctl_data_unref(data);
      break;
    }
    case USBDEVFS_SUBMITURB:
      submit(client, arg);
      break;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      reap(client, arg);
      break;
    case USBDEVFS_DISCARDURB:
      discard(client, arg);
      break;
    case USBDEVFS_CLEAR_HALT:
      stall_in_ = false;
      [[fallthrough]];
    default:  // claim, release, detach the kernel's driver
      umockdev_ioctl_client_complete(client, gone_ ? -1 : 0, gone_ ? ENODEV : 0);
  }
  return true;
}

void MockUsb::submit(UMockdevIoctlClient* client, UMockdevIoctlData* arg) {
  if (gone_) return umockdev_ioctl_client_complete(client, -1, ENODEV);
  UMockdevIoctlData* data = umockdev_ioctl_data_resolve(arg, 0, sizeof(usbdevfs_urb), nullptr);
  usbdevfs_urb& urb = urb_of(data);
  UMockdevIoctlData* buffer = umockdev_ioctl_data_resolve(
      data, G_STRUCT_OFFSET(usbdevfs_urb, buffer), static_cast<gulong>(urb.buffer_length), nullptr);
  if (buffer) umockdev_ioctl_data_unref(buffer);  // `data` keeps it
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL && !silent_) {
    run_control(urb);
    end({data, client, given_us_}, urb.status);
  } else {
    flying_.push_back({data, client, given_us_});
  }
  umockdev_ioctl_client_complete(client, 0, 0);
}

void MockUsb::run_control(usbdevfs_urb& urb) {
  auto* bytes = static_cast<std::uint8_t*>(urb.buffer);
  const auto u16 = [&](int at) {
    return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
  };
  const UsbSetup setup{bytes[0], bytes[1], u16(2), u16(4), u16(6)};
  const std::span<std::uint8_t> room(bytes + 8, static_cast<std::size_t>(urb.buffer_length) - 8);
  std::size_t size = 0;
  const bool ok = setup.is_in() ? device_->control(setup, {}, room, size)
                                : device_->control(setup, room, {}, size);
  urb.status = ok ? 0 : -EPIPE;
  urb.actual_length = static_cast<int>(setup.is_in() ? size : room.size());
}

void MockUsb::end(const Urb& urb, int status) {
  urb_of(urb.data).status = status;
  done_.push_back(urb);
}

void MockUsb::reap(UMockdevIoctlClient* client, UMockdevIoctlData* arg) {
  const auto found =
      std::find_if(done_.begin(), done_.end(), [&](const Urb& urb) { return urb.file == client; });
  if (found == done_.end()) {
    if (clock_ == Clock::kByPoll) frame();
    return umockdev_ioctl_client_complete(client, -1, gone_ ? ENODEV : EAGAIN);
  }
  UMockdevIoctlData* data = found->data;
  done_.erase(found);
  UMockdevIoctlData* pointer = umockdev_ioctl_data_resolve(arg, 0, sizeof(gpointer), nullptr);
  umockdev_ioctl_data_set_ptr(pointer, 0, data);
  umockdev_ioctl_client_complete(client, 0, 0);
  umockdev_ioctl_data_unref(pointer);
  umockdev_ioctl_data_unref(data);
}

void MockUsb::discard(UMockdevIoctlClient* client, UMockdevIoctlData* arg) {
  const gulong address = *reinterpret_cast<gulong*>(arg->data);
  const auto found = std::find_if(flying_.begin(), flying_.end(), [&](const Urb& urb) {
    return urb.file == client && urb.data->client_addr == address;
  });
  if (found == flying_.end()) return umockdev_ioctl_client_complete(client, -1, EINVAL);
  const Urb urb = *found;
  flying_.erase(found);
  end(urb, -ENOENT);
  umockdev_ioctl_client_complete(client, 0, 0);
}

MockUsb::Urb MockUsb::take_flying(bool in) {
  for (auto it = flying_.begin(); it != flying_.end(); ++it) {
    const usbdevfs_urb& urb = urb_of(it->data);
    if (urb.type == USBDEVFS_URB_TYPE_CONTROL || is_in(urb) != in) continue;
    const Urb found = *it;
    flying_.erase(it);
    return found;
  }
  return {};
}

void MockUsb::pump() {
  if (clock_ != Clock::kReal) return;
  const std::int64_t due = (g_get_monotonic_time() - start_us_) / 1000;
  while (frames_ < due) frame();
}

void MockUsb::frame() {
  ++frames_;
  const bool answers = !silent_ && !gone_;
  if (const Urb out = answers ? take_flying(false) : Urb{}; out.data) {
    usbdevfs_urb& urb = urb_of(out.data);
    device_->take_out(urb.endpoint, {static_cast<std::uint8_t*>(urb.buffer),
                                     static_cast<std::size_t>(urb.buffer_length)});
    urb.actual_length = urb.buffer_length;
    answer_ = {out.given_us, start_us_ + 1000 * frames_};
    end(out, 0);
  }
  device_->advance(frames_ * 1'000'000);
  if (!answers) return;
  std::array<std::uint8_t, UsbLink::kPacketBytes> packet;
  const Urb in = take_flying(true);
  if (!in.data) return;
  usbdevfs_urb& urb = urb_of(in.data);
  const std::size_t size = stall_in_ ? 0 : device_->give_in(urb.endpoint, packet);
  if (size == 0 && !stall_in_) {
    flying_.push_front(in);
    return;
  }
  urb.actual_length =
      static_cast<int>(std::min<std::size_t>(size, static_cast<std::size_t>(urb.buffer_length)));
  std::copy_n(packet.begin(), urb.actual_length, static_cast<std::uint8_t*>(urb.buffer));
  given_us_ = start_us_ + 1000 * frames_;
  end(in, stall_in_ ? -EPIPE : 0);
}

}  // namespace osteon::testing
