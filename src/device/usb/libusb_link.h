#pragma once

#include <memory>

#include "usb_transport.h"

namespace osteon {

/// Opens `entry` by libusb-1.0 with a context of the link's own, so that links on different threads
/// never meet.
Result<std::unique_ptr<UsbLink>> open_libusb_link(const UsbEntry& entry, const UsbChannel& channel);

}  // namespace osteon
