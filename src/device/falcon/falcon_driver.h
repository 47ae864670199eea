#pragma once

#include <memory>
#include <string>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/device/haptic_device.h"
#include "usb/usb_transport.h"

namespace osteon {

// The "falcon" line of the table of drivers.

Result<std::vector<DeviceInfo>> list_falcon();
Result<std::unique_ptr<HapticDevice>> open_falcon(const DeviceInfo& info);
std::vector<std::string> unusable_falcon();

// The same on a bus of the caller's choice.

/// Falcons that may be opened and whose firmware is at hand; `serial` is the serial number, or the
/// port of one without.
Result<std::vector<DeviceInfo>> list_falcons(UsbBus& bus);
/// Opens it and brings it up, which waits for some seconds.
Result<std::unique_ptr<HapticDevice>> open_falcon(UsbBus& bus, const DeviceInfo& info);
/// Falcons that are there but not listed, each with why.
std::vector<std::string> unusable_falcons(UsbBus& bus);

}  // namespace osteon
