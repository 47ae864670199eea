#include "emulated_usb.h"

#include "emulated_usb_link.h"
#include "osteon/base/check.h"

namespace osteon {

EmulatedUsbBus::EmulatedUsbBus() = default;
EmulatedUsbBus::~EmulatedUsbBus() = default;

std::string EmulatedUsbBus::attach(std::shared_ptr<EmulatedUsbDevice> device) {
  auto port = std::make_unique<Port>();
  port->name = "1-" + std::to_string(ports_.size() + 1);
  port->device = std::move(device);
  ports_.push_back(std::move(port));
  ++changes_.arrived;
  return ports_.back()->name;
}

void EmulatedUsbBus::detach(const std::string& name) {
  Port* port = find(name);
  if (!port || !port->plugged) return;
  port->plugged = false;
  if (port->link) port->link->unplug();
  port->device->disconnected();
  ++changes_.left;
}

EmulatedUsbBus::Port* EmulatedUsbBus::find(const std::string& name) {
  for (auto& port : ports_)
    if (port->name == name) return port.get();
  return nullptr;
}

UsbFaults& EmulatedUsbBus::faults(const std::string& name) {
  Port* port = find(name);
  demand(port != nullptr, "no such port on the emulated bus");
  return port->faults;
}

void EmulatedUsbBus::forbid(const std::string& name) {
  if (Port* port = find(name)) port->forbidden = true;
}

std::int64_t EmulatedUsbBus::now_ns() const { return now_ns_; }

void EmulatedUsbBus::advance(std::int64_t ns) {
  wanted_ns_ += ns;
  while (now_ns_ + kMicroframe_ns <= wanted_ns_) microframe();
}

void EmulatedUsbBus::microframe() {
  constexpr std::int64_t kFrame_ns = 1'000'000;
  now_ns_ += kMicroframe_ns;
  const bool frame = now_ns_ % kFrame_ns == 0;
  for (auto& port : ports_) {
    EmulatedUsbDevice& device = *port->device;
    const bool turn = port->plugged && (frame || device.speed() == UsbSpeed::kHigh);
    if (turn && port->link) port->link->frame_out(device, port->faults);
    device.advance(now_ns_);
    if (turn && port->link) port->link->frame_in(device, *port);
  }
}

std::vector<UsbEntry> EmulatedUsbBus::list(std::uint16_t vendor, std::uint16_t product) {
  std::vector<UsbEntry> entries;
  for (const auto& port : ports_) {
    if (!port->plugged) continue;
    UsbEntry entry = port->device->entry();
    if ((vendor != 0 && entry.vendor != vendor) || (product != 0 && entry.product != product))
      continue;
    entry.port = port->name;
    if (port->forbidden) {
      entry.serial.clear();
      entry.name.clear();
      entry.access_problem = "the USB device at " + port->name + " cannot be opened: no permission";
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

Result<std::unique_ptr<UsbLink>> EmulatedUsbBus::open(const UsbEntry& entry,
                                                      const UsbChannel& channel) {
  Port* port = find(entry.port);
  if (!port || !port->plugged)
    return fail("the USB device is no longer there", entry.port, "Plug it in again");
  if (port->forbidden)
    return fail("no permission to open the USB device", entry.port, "Install the udev rule");
  if (port->link) return fail("another program holds the USB device", entry.port, "Close it");
  const bool has_out = port->device->has_out_endpoint(channel.out_endpoint);
  if (!has_out && !channel.reports_by_control)
    return fail("the USB device lacks the endpoints that its profile names", entry.port,
                "Correct the profile in assets/devices");
  return std::make_unique<EmulatedUsbLink>(*this, *port, channel);
}

}  // namespace osteon
