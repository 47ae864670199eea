#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "osteon/base/result.h"
#include "osteon/device/haptic_device.h"

namespace osteon {

/// One line of the table of drivers.
struct Driver {
  const char* name;         ///< "mouse": `DeviceInfo::driver` of its devices
  const char* description;  ///< for a menu
  /// Devices that can be opened now.
  Result<std::vector<DeviceInfo>> (*list)();
  /// Opens a device that `list` gave.
  Result<std::unique_ptr<HapticDevice>> (*open)(const DeviceInfo& info);
  /// What is there but cannot be opened now, and what the driver itself lacks: each a sentence that
  /// says what and why and what to do. Null: the driver never has such.
  std::vector<std::string> (*unusable)() = nullptr;
};

/// Every driver of this build, in the order of a menu. A new driver adds a line here.
std::span<const Driver> drivers();

/// Opens the first device of the driver of that name.
Result<std::unique_ptr<HapticDevice>> open_device(std::string_view driver_name);

}  // namespace osteon
