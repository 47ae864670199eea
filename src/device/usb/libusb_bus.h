#pragma once

#include <memory>

#include "usb_transport.h"

namespace osteon {

/// The system's USB through libusb-1.0, in a context of its own. Fails where there is no USB at
/// all; that is for the caller to take calmly. No thread is started here: links and the bus handle
/// their events in `poll`, `wait` and `changes`.
Result<std::unique_ptr<UsbBus>> open_libusb_bus();

/// Lines of a udev rule that lets the user at the seat open this device.
std::string udev_rule(std::uint16_t vendor, std::uint16_t product);

}  // namespace osteon
