#include "libusb_bus.h"

#include "libusb_handles.h"
#include "libusb_link.h"

namespace osteon {
namespace {

std::string device_string(libusb_device_handle* handle, std::uint8_t index) {
  if (index == 0) return {};
  unsigned char text[256];
  const int size = libusb_get_string_descriptor_ascii(handle, index, text, sizeof text);
  return size > 0 ? std::string(reinterpret_cast<char*>(text), static_cast<std::size_t>(size))
                  : std::string();
}

std::string access_problem(int code, const UsbEntry& entry) {
  const std::string what = "the USB device " + usb_id(entry.vendor, entry.product) + " at " +
                           entry.port + " cannot be opened: ";
  if (code == LIBUSB_ERROR_ACCESS)
    return what + "no permission. Put this line into /etc/udev/rules.d/70-osteon.rules and plug " +
           "it in again: " + udev_rule(entry.vendor, entry.product);
  return what + libusb_strerror(static_cast<libusb_error>(code));
}

UsbEntry describe_device(libusb_device* device, const libusb_device_descriptor& d) {
  UsbEntry entry;
  entry.vendor = d.idVendor;
  entry.product = d.idProduct;
  entry.port = port_name(device);
  libusb_device_handle* opened = nullptr;
  const int code = libusb_open(device, &opened);
  const LibusbHandle handle(code == 0 ? opened : nullptr);
  if (!handle) {
    entry.access_problem = access_problem(code, entry);
    return entry;
  }
  entry.serial = device_string(handle.get(), d.iSerialNumber);
  entry.name = device_string(handle.get(), d.iProduct);
  return entry;
}

class LibusbBus : public UsbBus {
 public:
  explicit LibusbBus(LibusbContext context) : context_(std::move(context)) {
    if (!libusb_has_capability(LIBUSB_CAP_HAS_HOTPLUG)) return;
    libusb_hotplug_register_callback(
        context_.get(), LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED | LIBUSB_HOTPLUG_EVENT_DEVICE_LEFT, 0,
        LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, LIBUSB_HOTPLUG_MATCH_ANY, &on_hotplug,
        this, nullptr);
  }

  std::vector<UsbEntry> list(std::uint16_t vendor, std::uint16_t product) override {
    std::vector<UsbEntry> entries;
    for (libusb_device* device : LibusbDeviceList(context_.get())) {
      libusb_device_descriptor d{};
      if (libusb_get_device_descriptor(device, &d) != 0) continue;
      if ((vendor != 0 && d.idVendor != vendor) || (product != 0 && d.idProduct != product))
        continue;
      entries.push_back(describe_device(device, d));
    }
    return entries;
  }

  Result<std::unique_ptr<UsbLink>> open(const UsbEntry& entry, const UsbChannel& channel) override {
    return open_libusb_link(entry, channel);
  }

  UsbChanges changes() override {
    timeval now{0, 0};
    libusb_handle_events_timeout_completed(context_.get(), &now, nullptr);
    return changes_;
  }

 private:
  static int LIBUSB_CALL on_hotplug(libusb_context*, libusb_device*, libusb_hotplug_event event,
                                    void* self) {
    UsbChanges& changes = static_cast<LibusbBus*>(self)->changes_;
    ++(event == LIBUSB_HOTPLUG_EVENT_DEVICE_ARRIVED ? changes.arrived : changes.left);
    return 0;
  }

  LibusbContext context_;
  UsbChanges changes_;
};

}  // namespace

Result<std::unique_ptr<UsbBus>> open_libusb_bus() {
  int code = 0;
  LibusbContext context = make_libusb_context(code);
  if (!context)
    return fail("there is no USB on this computer",
                libusb_strerror(static_cast<libusb_error>(code)),
                "Use another device, or let this system see USB (/dev/bus/usb)");
  return std::make_unique<LibusbBus>(std::move(context));
}

std::string udev_rule(std::uint16_t vendor, std::uint16_t product) {
  char text[128];
  std::snprintf(text, sizeof text,
                R"(SUBSYSTEM=="usb", ATTR{idVendor}=="%04x", ATTR{idProduct}=="%04x", )"
                R"(TAG+="uaccess")",
                vendor, product);
  return text;
}

}  // namespace osteon
