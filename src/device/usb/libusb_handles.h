#pragma once

#include <libusb.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace osteon {

struct LibusbContextExit {
  void operator()(libusb_context* context) const { libusb_exit(context); }
};
using LibusbContext = std::unique_ptr<libusb_context, LibusbContextExit>;

struct LibusbClose {
  void operator()(libusb_device_handle* handle) const { libusb_close(handle); }
};
using LibusbHandle = std::unique_ptr<libusb_device_handle, LibusbClose>;

/// A context of the caller's own; null where there is no USB. `code` tells why.
inline LibusbContext make_libusb_context(int& code) {
  libusb_context* context = nullptr;
  code = libusb_init(&context);
  return LibusbContext(code == 0 ? context : nullptr);
}

/// The devices on the bus for as long as this lives.
class LibusbDeviceList {
 public:
  explicit LibusbDeviceList(libusb_context* context)
      : count_(libusb_get_device_list(context, &list_)) {}
  ~LibusbDeviceList() {
    if (count_ >= 0) libusb_free_device_list(list_, 1);
  }
  LibusbDeviceList(const LibusbDeviceList&) = delete;
  LibusbDeviceList& operator=(const LibusbDeviceList&) = delete;
  libusb_device** begin() const { return list_; }
  libusb_device** end() const { return count_ > 0 ? list_ + count_ : list_; }

 private:
  libusb_device** list_ = nullptr;
  ssize_t count_ = 0;
};

/// "1-2.3": the bus and the ports on the way. A device that tells no ports is named by its address:
/// "1@7".
inline std::string port_name(libusb_device* device) {
  std::uint8_t ports[8] = {};
  const int count = libusb_get_port_numbers(device, ports, 8);
  std::string name = std::to_string(libusb_get_bus_number(device));
  if (count <= 0) return name + "@" + std::to_string(libusb_get_device_address(device));
  for (int i = 0; i < count; ++i) name += (i == 0 ? "-" : ".") + std::to_string(ports[i]);
  return name;
}

inline std::string usb_id(std::uint16_t vendor, std::uint16_t product) {
  char text[16];
  std::snprintf(text, sizeof text, "%04x:%04x", vendor, product);
  return text;
}

}  // namespace osteon
